#include "mpi_drivers/partition/sub_collection.hpp"

#include <algorithm>

#include "src/base/index.hpp"

namespace coseg {

namespace {

/// What the stages after the features ask of a mesh.
MeshDescription relations_of(const MeshDescription& whole, int number) {
    MeshDescription part;
    part.mesh = number;
    part.key = whole.key;
    part.patch_counts = whole.patch_counts;
    part.neighbors = whole.neighbors;
    part.overlaps = whole.overlaps;
    return part;
}

}  // namespace

PartCollection part_of_collection(const Comm& comm, const Collection& collection,
                                  const PatchFeatures& features, const std::vector<int>& meshes) {
    PartCollection part;
    const PatchNumbering& numbering = collection.numbering;
    std::vector<int> counts;
    for (const int m : meshes) {
        part.collection.meshes.push_back(collection.meshes[at(m)]);
        for (int s = 0; s < numbering.oversegmentations(); ++s) {
            counts.push_back(numbering.count(m, s));
            for (int k = 0; k < numbering.count(m, s); ++k)
                part.patch_of.push_back(numbering.first(m, s) + k);
        }
    }
    part.collection.numbering = PatchNumbering(numbering.oversegmentations(), counts);
    for (const MeshDescription& mesh : collection.local) {
        const auto place = std::lower_bound(meshes.begin(), meshes.end(), mesh.mesh);
        if (place != meshes.end() && *place == mesh.mesh)
            part.collection.local.push_back(relations_of(mesh, static_cast<int>(place - meshes.begin())));
    }
    part.features.histograms = features.histograms.chosen(comm, part.patch_of);
    part.features.descriptors = features.descriptors;
    for (const int patch : part.patch_of) part.features.patch_area.push_back(features.patch_area[at(patch)]);
    part.features.positions = features.positions(Eigen::all, part.patch_of);
    return part;
}

}  // namespace coseg
