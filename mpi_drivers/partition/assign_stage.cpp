#include "mpi_drivers/partition/assign_stage.hpp"

#include <algorithm>
#include <optional>
#include <tuple>
#include <utility>

#include "mpi_drivers/describe/patch_gather.hpp"
#include "mpi_drivers/partition/cut_stage.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/parallel/record_exchange.hpp"

namespace coseg {

namespace {

/// The meshes of which examples say something, on all ranks.
std::vector<char> labelled_meshes(const AssignInput& input) {
    std::vector<char> labelled(input.collection.meshes.size(), 0);
    const std::vector<int> mesh_of = input.collection.numbering.mesh_of();
    for (Eigen::Index i = 0; i < input.examples.area.cols(); ++i) {
        if (input.examples.area.col(i).sum() > 0.0) labelled[at(mesh_of[at(i)])] = 1;
    }
    return labelled;
}

/// Of this rank's meshes those that are labelled, or those that are not.
std::vector<MeshOutcome> assign_meshes(const AssignInput& input, const std::vector<char>& labelled,
                                       bool which, const OptimiseOptions& options) {
    const Comm self(MPI_COMM_SELF);
    std::vector<MeshOutcome> outcomes;
    std::optional<KnownMeshes> known;
    for (const MeshDescription& mesh : input.collection.local) {
        if ((labelled[at(mesh.mesh)] != 0) != which) continue;
        if (!known) known.emplace(known_meshes(input.model, input.features.descriptors));
        outcomes.push_back(assign_mesh(self, mesh, input, *known, options));
    }
    return outcomes;
}

/// A labelled mesh, for other ranks.
struct PartsOfMesh {
    int mesh = 0;
    std::vector<int> parts;
    std::vector<GlobalPatchNeighbors> neighbors;  ///< of its patches 0, 1, ...
    ShapePose pose;
    static constexpr auto fields() {
        return std::tuple(field("mesh", &PartsOfMesh::mesh), field("parts", &PartsOfMesh::parts),
                          field("neighbors", &PartsOfMesh::neighbors), field("pose", &PartsOfMesh::pose));
    }
};

/// Of all ranks, in the order of meshes. Collective.
std::vector<PartsOfMesh> gather_parts(const Comm& comm, const Collection& collection,
                                      const std::vector<MeshOutcome>& outcomes) {
    std::vector<PartsOfMesh> local;
    for (const MeshOutcome& outcome : outcomes)
        local.push_back({outcome.figures.mesh, outcome.parts.parts, {}, outcome.figures.pose.pose});
    auto next = local.begin();  // both ascend
    for (const MeshDescription& mesh : collection.local) {
        if (next != local.end() && next->mesh == mesh.mesh) (next++)->neighbors = neighbors_of(mesh, 0);
    }
    std::vector<PartsOfMesh> all = all_gather_records(comm, local);
    std::sort(all.begin(), all.end(),
              [](const PartsOfMesh& a, const PartsOfMesh& b) { return a.mesh < b.mesh; });
    return all;
}

/// The model, as if these new meshes had been in its run.
RunModel with_meshes(RunModel model, const AssignInput& input, const std::vector<PartsOfMesh>& meshes) {
    for (const PartsOfMesh& mesh : meshes) {
        const auto number = static_cast<int>(model.mesh_names.size());
        const auto count = static_cast<Eigen::Index>(mesh.parts.size());
        const int first = input.collection.numbering.first(mesh.mesh, 0);
        for (std::size_t h = 0; h < model.histograms.size(); ++h) {
            Eigen::MatrixXd& known = model.histograms[h];
            known.conservativeResize(Eigen::NoChange, known.cols() + count);
            known.rightCols(count) =
                input.features.histograms[h].middleCols(first, count).cast<float>().cast<double>();
        }
        const auto known = static_cast<int>(model.mesh_of.size());
        for (GlobalPatchNeighbors pair : mesh.neighbors) {
            pair.patch_a += known;
            pair.patch_b += known;
            model.places.neighbors.push_back(pair);
        }
        const auto areas = input.features.patch_area.begin() + first;
        model.places.area.insert(model.places.area.end(), areas, areas + count);
        model.places.positions.conservativeResize(Eigen::NoChange, known + count);
        model.places.positions.rightCols(count) =
            turned_positions(mesh.pose, input.features.positions.middleCols(first, count));
        model.mesh_of.insert(model.mesh_of.end(), mesh.parts.size(), number);
        model.mesh_names.push_back(input.collection.meshes[at(mesh.mesh)].name);
        model.part_of_patch.insert(model.part_of_patch.end(), mesh.parts.begin(), mesh.parts.end());
    }
    return model;
}

/// First the meshes of which examples say something, then the others; of this rank, in the order of meshes.
/// Collective.
std::vector<MeshOutcome> assign_by_examples(const Comm& comm, const AssignInput& input,
                                            const OptimiseOptions& options) {
    const std::vector<char> labelled = labelled_meshes(input);
    std::vector<MeshOutcome> outcomes;
    agree(comm, [&] { outcomes = assign_meshes(input, labelled, true, options); });
    const RunModel model = with_meshes(input.model, input, gather_parts(comm, input.collection, outcomes));
    agree(comm, [&] {
        const AssignInput others{input.collection, input.features, model, input.examples};
        for (MeshOutcome& outcome : assign_meshes(others, labelled, false, options))
            outcomes.push_back(std::move(outcome));
    });
    std::sort(outcomes.begin(), outcomes.end(),
              [](const MeshOutcome& a, const MeshOutcome& b) { return a.figures.mesh < b.figures.mesh; });
    return outcomes;
}

/// Collective.
std::vector<MeshOutcome> assign_alone(const Comm& comm, const AssignInput& input,
                                      const OptimiseOptions& options) {
    const std::vector<char> none(input.collection.meshes.size(), 0);
    std::vector<MeshOutcome> outcomes;
    agree(comm, [&] { outcomes = assign_meshes(input, none, false, options); });
    return outcomes;
}

/// Parts, confidence and scores of all patches, on all ranks. Collective.
CutResult joined_parts(const Comm& comm, const Collection& collection,
                       const std::vector<MeshOutcome>& outcomes, int parts) {
    std::vector<Eigen::MatrixXd> local;
    for (const MeshOutcome& outcome : outcomes) {
        const auto count = static_cast<Eigen::Index>(outcome.parts.parts.size());
        Eigen::MatrixXd rows(2 + parts, count);
        rows.row(0) = Eigen::Map<const Eigen::RowVectorXi>(outcome.parts.parts.data(), count).cast<double>();
        rows.row(1) = Eigen::Map<const Eigen::RowVectorXd>(outcome.parts.confidence.data(), count);
        rows.bottomRows(parts) = outcome.scores.cast<double>();
        local.push_back(std::move(rows));
    }
    const Eigen::MatrixXd all = gather_patch_columns(comm, collection, local, 2 + parts);
    CutResult cut;
    for (const double part : all.row(0)) cut.part_of_patch.push_back(static_cast<int>(part));
    if (parts == 1) return cut;  // of a single part there is nothing to be sure of, as in a run
    cut.confidence.assign(all.row(1).begin(), all.row(1).end());
    cut.scores = all.bottomRows(parts).cast<float>();
    return cut;
}

SolveSummary summed(const std::vector<AssignedMesh>& meshes) {
    SolveSummary sum;
    for (const AssignedMesh& mesh : meshes) {
        add_certificate(sum, mesh.solution);
    }
    sum.relative_gap = relative_gap(sum.objective - sum.lower_bound,
                                    gap_scale(PenaltyScope::meshes, sum.objective, sum.objective_at_zero),
                                    sum.objective_at_zero);
    return sum;
}

/// Of all ranks, in the order of meshes.
std::vector<AssignedMesh> gather_figures(const Comm& comm, const std::vector<MeshOutcome>& outcomes) {
    std::vector<AssignedMesh> local;
    for (const MeshOutcome& outcome : outcomes) local.push_back(outcome.figures);
    std::vector<AssignedMesh> meshes = all_gather_records(comm, local);
    std::sort(meshes.begin(), meshes.end(),
              [](const AssignedMesh& a, const AssignedMesh& b) { return a.mesh < b.mesh; });
    return meshes;
}

/// What was turned to stand like the run's shapes.
ShapeAlignment alignment_of(const std::vector<AssignedMesh>& meshes) {
    const auto count = static_cast<double>(meshes.size());
    ShapeAlignment alignment;
    std::ptrdiff_t turned = 0;
    for (const AssignedMesh& mesh : meshes) {
        alignment.shapes.push_back(mesh.pose.pose);
        alignment.agreement_before += mesh.pose.agreement_in_file / count;
        alignment.agreement_after += mesh.pose.pose.agreement / count;
        turned += mesh.pose.pose.is_turned() ? 1 : 0;
    }
    alignment.standing_share = 1.0 - static_cast<double>(turned) / count;
    alignment.reason = std::to_string(turned) + " of " + std::to_string(meshes.size()) +
                       " turned to stand like the run's shapes";
    if (turned == 0) alignment.shapes.clear();
    return alignment;
}

}  // namespace

Assigned assign_parts(const Comm& comm, const AssignInput& input, const OptimiseOptions& options,
                      StageLog& log) {
    log.begin("assign");
    const std::vector<MeshOutcome> outcomes = input.examples.empty()
                                                  ? assign_alone(comm, input, options)
                                                  : assign_by_examples(comm, input, options);
    const std::vector<AssignedMesh> figures = gather_figures(comm, outcomes);
    Assigned assigned;
    assigned.cut = joined_parts(comm, input.collection, outcomes, input.model.options.partition.parts);
    assigned.alignment = alignment_of(figures);
    Optimisation& optimisation = assigned.optimisation;
    static_cast<SolveSummary&>(optimisation.result) = summed(figures);
    optimisation.variant = to_string(SubspaceVariant::multi_feature);
    optimisation.scope = to_string(PenaltyScope::meshes);
    optimisation.links = static_cast<int>(input.model.mesh_names.size());
    for (const AssignedMesh& mesh : figures) optimisation.allowed_pairs += mesh.allowed_pairs;
    for (const Descriptor& descriptor : input.features.descriptors)
        optimisation.features.push_back(descriptor.name);
    SparseCoefficients& none = optimisation.result.coefficients;
    none.size = static_cast<std::int64_t>(assigned.cut.part_of_patch.size());
    none.columns = block_range(none.size, comm.size(), comm.rank(), coefficient_tile);
    none.features = static_cast<int>(optimisation.features.size());
    none.offsets.assign(static_cast<std::size_t>(none.columns.size()) + 1, 0);
    log.end(describe(optimisation));
    return assigned;
}

}  // namespace coseg
