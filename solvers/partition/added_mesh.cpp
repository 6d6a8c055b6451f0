#include "solvers/partition/added_mesh.hpp"

#include <algorithm>

#include "solvers/choice/partition_objective.hpp"
#include "solvers/partition/corrected_parts.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

int added_count(const AddedMesh& mesh) { return static_cast<int>(mesh.scores.cols()); }

int known_count(const AddedMesh& mesh) { return static_cast<int>(mesh.known_parts.size()); }

void refuse_lengths(const AddedMesh& mesh) {
    const std::size_t patches = mesh.known_parts.size() + at(added_count(mesh));
    if (mesh.mesh_of.size() == patches && mesh.patch_area.size() == patches &&
        at(mesh.links.size) == patches && mesh.said.rows() == mesh.scores.rows() &&
        mesh.said.cols() == mesh.scores.cols() && added_count(mesh) > 0)
        return;
    throw Error(ExitCode::internal, "what is known of an added mesh is of different lengths");
}

/// Only the added mesh has overlaps and links here. In a run every mesh has as many of them, and a term is
/// their share of all.
ChoiceWeights as_in_a_run(ChoiceWeights weights, int meshes) {
    weights.overlap /= meshes;
    weights.links /= meshes;
    return weights;
}

/// The part to which most of the patch's links lead, by weight; without links, the one with the best score.
int linked_part(const AddedMesh& mesh, int patch) {
    Eigen::VectorXd share = Eigen::VectorXd::Zero(mesh.scores.rows());
    const auto row = at(known_count(mesh) + patch);
    for (auto k = at(mesh.links.offsets[row]); k < at(mesh.links.offsets[row + 1]); ++k) {
        if (mesh.links.columns[k] < known_count(mesh))
            share[mesh.known_parts[at(mesh.links.columns[k])]] += mesh.links.values[k];
    }
    Eigen::Index part = 0;
    if (share.maxCoeff(&part) <= 0.0) mesh.scores.col(patch).maxCoeff(&part);
    return static_cast<int>(part);
}

/// All that is known, as of corrections.
SaidParts said_parts(const AddedMesh& mesh, int meshes) {
    const Eigen::Index parts = mesh.scores.rows();
    SaidParts said{mesh.known_parts, Eigen::MatrixXd::Zero(parts, known_count(mesh) + added_count(mesh)),
                   Eigen::MatrixXi::Ones(parts, meshes)};
    for (int i = 0; i < known_count(mesh); ++i)
        said.area(mesh.known_parts[at(i)], i) = mesh.patch_area[at(i)];
    said.area.rightCols(added_count(mesh)) = mesh.said;
    for (int i = 0; i < added_count(mesh); ++i) said.base.push_back(linked_part(mesh, i));
    return said;
}

}  // namespace

AddedParts added_parts(const AddedMesh& mesh, const ChoiceWeights& weights, const ExampleWeights& gains) {
    refuse_lengths(mesh);
    if (mesh.scores.rows() == 1)
        return {std::vector<int>(at(added_count(mesh)), 0), std::vector<double>(at(added_count(mesh)), 1.0)};
    const int meshes = mesh_count(mesh.mesh_of);
    const PartitionEvidence evidence{mesh.neighbors, mesh.overlaps,   mesh.descriptors,
                                     mesh.mesh_of,   mesh.patch_area, mesh.links};
    const PartitionObjective objective = partition_objective(evidence, as_in_a_run(weights, meshes));
    const SaidParts said = said_parts(mesh, meshes);
    Eigen::MatrixXd scores = Eigen::MatrixXd::Zero(mesh.scores.rows(), said.area.cols());
    scores.rightCols(added_count(mesh)) = mesh.scores;
    hold_known_labels({said.area}, mesh.patch_area, scores);
    const CorrectedPartition found = corrected_partition(Comm(MPI_COMM_SELF), objective, said, scores, gains);
    return {{found.parts.begin() + known_count(mesh), found.parts.end()},
            {found.confidence.begin() + known_count(mesh), found.confidence.end()}};
}

}  // namespace coseg
