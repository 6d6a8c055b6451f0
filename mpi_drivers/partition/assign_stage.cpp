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
    std::vector<int> parts;  ///< of the mesh's patches
    AssignedMesh figures;
};

/// The meshes of which examples say something, on all ranks.
std::vector<char> labelled_meshes(const AssignInput& input) {
    std::vector<char> labelled(input.collection.meshes.size(), 0);
    const std::vector<int> mesh_of = input.collection.numbering.mesh_of();
    for (Eigen::Index i = 0; i < input.examples.area.cols(); ++i) {
        if (input.examples.area.col(i).sum() > 0.0) labelled[at(mesh_of[at(i)])] = 1;
    }
    return labelled;
}

MeshOutcome assign_mesh(const Comm& self, const MeshDescription& mesh, const AssignInput& input,
                        const std::vector<int>& known, const OptimiseOptions& options) {
    const int first = input.collection.numbering.first(mesh.mesh, 0);
    const int count = input.collection.numbering.count(mesh.mesh);
    const SubspaceProblem problem = problem_of(self, input.model, input.features, first, count);
    const SolveOptions solve{
        .gap = options.gap, .max_iterations = options.max_iterations, .max_seconds = options.max_seconds};
    const SolveResult result = solve_subspace(self, problem, solve);
    MeshOutcome outcome;
    outcome.figures = {mesh.mesh, own_share(result, input.features, first, count),
                       allowed_pair_count(problem)};
    PropagationInput propagation = propagation_input(mesh, input.collection.numbering,
                                                     evidence_of(result.coefficients, input.model, count));
    if (!known.empty()) propagation.known.assign(known.begin() + first, known.begin() + first + count);
    outcome.parts = propagate_labels(propagation, assign_bonds);
    if (std::find(outcome.parts.begin(), outcome.parts.end(), -1) != outcome.parts.end()) {
        throw Error(ExitCode::input,
                    input.collection.meshes[at(mesh.mesh)].path +
                        ": patches of it have nothing in common with the run's shapes; leave it out");
    }
    return outcome;
}

/// Of this rank's meshes those that are labelled, or those that are not.
std::vector<MeshOutcome> assign_meshes(const AssignInput& input, const std::vector<char>& labelled,
                                       bool which, const OptimiseOptions& options) {
    const Comm self(MPI_COMM_SELF);
    std::vector<int> known;
    if (which) known = known_labels(input.examples, input.features.patch_area);
    std::vector<MeshOutcome> outcomes;
    for (const MeshDescription& mesh : input.collection.local) {
        if ((labelled[at(mesh.mesh)] != 0) == which)
            outcomes.push_back(assign_mesh(self, mesh, input, known, options));
    }
    return outcomes;
}

/// Parts of the patches of one mesh, for other ranks.
struct PartsOfMesh {
    int mesh = 0;
    std::vector<int> parts;
    static constexpr auto fields() {
        return std::tuple(field("mesh", &PartsOfMesh::mesh), field("parts", &PartsOfMesh::parts));
    }
};

/// Of all ranks, in the order of meshes. Collective.
std::vector<PartsOfMesh> gather_parts(const Comm& comm, const std::vector<MeshOutcome>& outcomes) {
    std::vector<PartsOfMesh> local;
    for (const MeshOutcome& outcome : outcomes) local.push_back({outcome.figures.mesh, outcome.parts});
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
    const RunModel model = with_meshes(input.model, input, gather_parts(comm, outcomes));
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

/// Of all patches, on all ranks. Collective.
std::vector<int> parts_of_patches(const Comm& comm, const Collection& collection,
                                  const std::vector<MeshOutcome>& outcomes) {
    std::vector<Eigen::MatrixXd> local;
    for (const MeshOutcome& outcome : outcomes)
        local.emplace_back(Eigen::Map<const Eigen::RowVectorXi>(
                               outcome.parts.data(), static_cast<Eigen::Index>(outcome.parts.size()))
                               .cast<double>());
    std::vector<int> parts;
    for (const double part : gather_patch_columns(comm, collection, local, 1).reshaped())
        parts.push_back(static_cast<int>(part));
    return parts;
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

Assigned assign_parts(const Comm& comm, const AssignInput& input, const OptimiseOptions& options,
                      StageLog& log) {
    log.begin("assign");
    const std::vector<MeshOutcome> outcomes = input.examples.empty()
                                                  ? assign_alone(comm, input, options)
                                                  : assign_by_examples(comm, input, options);
    const std::vector<AssignedMesh> figures = gather_figures(comm, outcomes);
    Assigned assigned;
    assigned.cut.part_of_patch = parts_of_patches(comm, input.collection, outcomes);
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
