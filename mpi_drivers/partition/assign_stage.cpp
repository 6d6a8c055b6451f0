#include "mpi_drivers/partition/assign_stage.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "mpi_drivers/describe/patch_gather.hpp"
#include "solvers/partition/label_propagation.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/parallel/record_exchange.hpp"

namespace coseg {

namespace {

/// The run's patches, then those of one new mesh; only the new columns have rows, those of the run's meshes.
SubspaceProblem problem_of(const Comm& self, const RunModel& model, const PatchFeatures& features, int first,
                           int count) {
    SubspaceProblem problem;
    std::vector<Eigen::Index> rows;
    for (const Eigen::MatrixXd& known : model.histograms) rows.push_back(known.rows());
    problem.features = FeatureMatrices(self, rows, model.histograms.front().cols() + count);
    for (std::size_t h = 0; h < rows.size(); ++h) {
        FeatureMatrices::Block both = problem.features.fill(h);
        both << model.histograms[h], features.histograms[h].middleCols(first, count);
    }
    const auto meshes = static_cast<int>(model.mesh_names.size());
    problem.scope = PenaltyScope::meshes;
    problem.mesh_of = model.mesh_of;
    problem.mesh_of.insert(problem.mesh_of.end(), static_cast<std::size_t>(count), meshes);
    problem.allowed_meshes.resize(static_cast<std::size_t>(meshes) + 1);
    problem.allowed_meshes.back().resize(static_cast<std::size_t>(meshes));
    std::iota(problem.allowed_meshes.back().begin(), problem.allowed_meshes.back().end(), 0);
    problem.alpha = model.options.optimise.alpha;
    problem.beta = model.options.optimise.beta;
    problem.lambda = model.options.optimise.lambda;
    return problem;
}

/// K x count: the shares of each new patch's links by the part of the run's patch.
Eigen::MatrixXd evidence_of(const SparseCoefficients& w, const RunModel& model, int count) {
    const auto known = static_cast<std::int64_t>(model.part_of_patch.size());
    const auto features = static_cast<std::size_t>(w.features);
    Eigen::MatrixXd evidence = Eigen::MatrixXd::Zero(model.options.partition.parts, count);
    for (int j = 0; j < count; ++j) {
        const auto column = static_cast<std::size_t>(known + j - w.columns.begin);
        for (auto k = static_cast<std::size_t>(w.offsets[column]);
             k < static_cast<std::size_t>(w.offsets[column + 1]); ++k) {
            const double norm =
                Eigen::Map<const Eigen::VectorXd>(w.values.data() + k * features, w.features).norm();
            evidence(model.part_of_patch[at(w.rows[k])], j) += norm;
        }
        const double sum = evidence.col(j).sum();
        if (sum > 0.0) evidence.col(j) /= sum;
    }
    return evidence;
}

PropagationInput propagation_input(const MeshDescription& mesh, const PatchNumbering& numbering,
                                   Eigen::MatrixXd evidence) {
    PropagationInput input{.evidence = std::move(evidence), .neighbors = {}, .overlaps = {}};
    const int mesh_first = numbering.first(mesh.mesh, 0);
    const auto first = [&](int s) { return numbering.first(mesh.mesh, s) - mesh_first; };
    for (std::size_t s = 0; s < mesh.neighbors.size(); ++s) {
        const int begin = first(static_cast<int>(s));
        for (const PatchNeighbors& n : mesh.neighbors[s])
            input.neighbors.push_back({begin + n.patch_a, begin + n.patch_b, n.boundary_length, n.concavity});
    }
    for (const OverlapsOfPair& pair : mesh.overlaps) {
        for (const PatchOverlap& o : pair.overlaps) {
            input.overlaps.push_back({first(pair.oversegmentation_a) + o.patch_a,
                                      first(pair.oversegmentation_b) + o.patch_b, o.intersection_over_union});
        }
    }
    return input;
}

/// What a mesh adds to the report, gathered in the order of meshes so that sums do not depend on the ranks.
struct AssignedMesh {
    int mesh = 0;
    SolveSummary solution;
    std::int64_t allowed_pairs = 0;
    static constexpr auto fields() {
        return std::tuple(field("mesh", &AssignedMesh::mesh), field("solution", &AssignedMesh::solution),
                          field("allowed_pairs", &AssignedMesh::allowed_pairs));
    }
};

/// The solve without the run's columns, which have no rows here, and without its history.
SolveSummary own_share(const SolveResult& result, const PatchFeatures& features, int first, int count) {
    double zero = 0.0;
    for (std::size_t h = 0; h < features.histograms.size(); ++h) {
        const Eigen::MatrixXd own = features.histograms[h].middleCols(first, count);
        zero += own.squaredNorm();
    }
    const double others = result.objective_at_zero - zero;
    SolveSummary share = result;
    share.objective_at_zero = zero;
    share.objective -= others;
    share.lower_bound = std::max(result.lower_bound - others, 0.0);
    share.history.clear();
    return share;
}

struct MeshOutcome {
    std::vector<int> parts;
    AssignedMesh figures;
};

MeshOutcome assign_mesh(const Comm& self, const MeshDescription& mesh, const Collection& collection,
                        const PatchFeatures& features, const RunModel& model,
                        const OptimiseOptions& options) {
    const int first = collection.numbering.first(mesh.mesh, 0);
    const int count = collection.numbering.count(mesh.mesh);
    const SubspaceProblem problem = problem_of(self, model, features, first, count);
    const SolveOptions solve{
        .gap = options.gap, .max_iterations = options.max_iterations, .max_seconds = options.max_seconds};
    const SolveResult result = solve_subspace(self, problem, solve);
    MeshOutcome outcome;
    outcome.figures = {mesh.mesh, own_share(result, features, first, count), allowed_pair_count(problem)};
    outcome.parts = propagate_labels(
        propagation_input(mesh, collection.numbering, evidence_of(result.coefficients, model, count)),
        assign_bonds);
    if (std::find(outcome.parts.begin(), outcome.parts.end(), -1) != outcome.parts.end()) {
        throw Error(ExitCode::input,
                    collection.meshes[at(mesh.mesh)].path +
                        ": patches of it have nothing in common with the run's shapes; leave it out");
    }
    return outcome;
}

SolveSummary summed(const std::vector<AssignedMesh>& meshes) {
    SolveSummary sum;
    for (const AssignedMesh& mesh : meshes) {
        const SolveSummary& own = mesh.solution;
        sum.objective_at_zero += own.objective_at_zero;
        sum.objective += own.objective;
        sum.lower_bound += own.lower_bound;
        sum.kkt_residual = std::max(sum.kkt_residual, own.kkt_residual);
        sum.iterations = std::max(sum.iterations, own.iterations);
        sum.passes = std::max(sum.passes, own.passes);
        sum.nonzero_groups += own.nonzero_groups;
        sum.reason = std::max(sum.reason, own.reason);
    }
    const double decrease = sum.objective_at_zero - sum.objective;
    sum.relative_gap = decrease > 0.0 ? std::max(sum.objective - sum.lower_bound, 0.0) / decrease : 0.0;
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

}  // namespace

Assigned assign_parts(const Comm& comm, const Collection& collection, const PatchFeatures& features,
                      const RunModel& model, const OptimiseOptions& options, StageLog& log) {
    log.begin("assign");
    const Comm self(MPI_COMM_SELF);
    std::vector<MeshOutcome> outcomes;
    std::vector<Eigen::MatrixXd> parts_local;
    agree(comm, [&] {
        for (const MeshDescription& mesh : collection.local) {
            outcomes.push_back(assign_mesh(self, mesh, collection, features, model, options));
            const std::vector<int>& parts = outcomes.back().parts;
            parts_local.emplace_back(
                Eigen::Map<const Eigen::RowVectorXi>(parts.data(), static_cast<Eigen::Index>(parts.size()))
                    .cast<double>());
        }
    });
    const Eigen::MatrixXd all = gather_patch_columns(comm, collection, parts_local, 1);
    const std::vector<AssignedMesh> figures = gather_figures(comm, outcomes);
    Assigned assigned;
    for (const double part : all.reshaped()) assigned.cut.part_of_patch.push_back(static_cast<int>(part));
    Optimisation& optimisation = assigned.optimisation;
    static_cast<SolveSummary&>(optimisation.result) = summed(figures);
    optimisation.variant = to_string(SubspaceVariant::multi_feature);
    optimisation.scope = to_string(PenaltyScope::meshes);
    optimisation.links = static_cast<int>(model.mesh_names.size());
    for (const AssignedMesh& mesh : figures) optimisation.allowed_pairs += mesh.allowed_pairs;
    for (const Descriptor& descriptor : features.descriptors)
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
