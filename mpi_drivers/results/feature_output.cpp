#include "mpi_drivers/results/feature_output.hpp"

#include "io/data_files/feature_file.hpp"
#include "mpi_drivers/partition/cut_stage.hpp"
#include "src/base/index.hpp"

namespace coseg {

void write_features(const Comm& comm, const Collection& collection, const PatchFeatures& features,
                    const std::string& path) {
    const int patches = collection.numbering.patch_count();
    const std::vector<GlobalPatchNeighbors> neighbors =
        gather_patch_pairs(comm, local_neighbors(collection), patches);
    const std::vector<GlobalPatchOverlap> overlaps =
        gather_patch_pairs(comm, local_overlaps(collection), patches);
    agree(comm, [&] {
        if (!comm.is_root()) return;
        FeatureFile file;
        for (const Descriptor& descriptor : features.descriptors) file.names.push_back(descriptor.name);
        file.features = features.histograms.matrices();
        file.mesh_of = collection.numbering.mesh_of();
        for (const MeshFacts& mesh : collection.meshes) file.mesh_names.push_back(mesh.name);
        file.patch_area = features.patch_area;
        for (const GlobalPatchNeighbors& pair : neighbors) {
            file.neighbors.first.push_back(pair.patch_a);
            file.neighbors.second.push_back(pair.patch_b);
            file.neighbors.weight.push_back(pair.boundary_length);
            file.concavity.push_back(pair.concavity);
        }
        for (const GlobalPatchOverlap& pair : overlaps) {
            file.overlaps.first.push_back(pair.patch_a);
            file.overlaps.second.push_back(pair.patch_b);
            file.overlaps.weight.push_back(pair.intersection_over_union);
        }
        write_feature_file(path, file);
    });
}

}  // namespace coseg
