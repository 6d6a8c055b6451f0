#include "mpi_drivers/label_stage.hpp"

#include "src/face_labels.hpp"

namespace coseg {

namespace {

std::vector<std::vector<int>> parts_of_mesh(const PatchNumbering& numbering, int mesh,
                                            const std::vector<int>& part_of_patch) {
    std::vector<std::vector<int>> parts;
    for (int s = 0; s < numbering.oversegmentations(); ++s) {
        const auto first = part_of_patch.begin() + numbering.first(mesh, s);
        parts.emplace_back(first, first + numbering.count(mesh, s));
    }
    return parts;
}

std::vector<double> area_shares(const Eigen::VectorXd& area, const std::vector<int>& part_of_face,
                                int parts) {
    std::vector<double> share(static_cast<std::size_t>(parts), 0.0);
    for (std::size_t f = 0; f < part_of_face.size(); ++f) {
        share[static_cast<std::size_t>(part_of_face[f])] += area[static_cast<Eigen::Index>(f)];
    }
    return share;
}

}  // namespace

std::vector<MeshLabels> label_faces(const Collection& collection, const std::vector<int>& part_of_patch,
                                    int parts) {
    std::vector<MeshLabels> labels;
    for (const MeshDescription& mesh : collection.local) {
        const auto part_of = parts_of_mesh(collection.numbering, mesh.mesh, part_of_patch);
        const std::vector<int> part_of_face = vote_face_labels(mesh.patches, part_of, parts, mesh.graph);
        labels.push_back({.mesh = mesh.mesh,
                          .part = carry_labels_back(mesh.map, part_of_face, mesh.geometry.area),
                          .patch = carry_labels_back(mesh.map, mesh.patches.front(), mesh.geometry.area),
                          .part_area = area_shares(mesh.geometry.area, part_of_face, parts)});
    }
    return labels;
}

}  // namespace coseg
