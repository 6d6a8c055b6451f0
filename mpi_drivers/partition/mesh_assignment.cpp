#include "mpi_drivers/partition/mesh_assignment.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "mpi_drivers/optimise/optimise_stage.hpp"
#include "mpi_drivers/partition/cut_stage.hpp"
#include "solvers/affinity/affinity.hpp"
#include "solvers/alignment/shape_alignment.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"

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

bool places_count(const RunModel& model) { return !model.places.frame.correlation.isZero(); }

/// What the run's labels say: each patch has its part, as much as its area.
Eigen::MatrixXd said_areas(const RunModel& model) {
    Eigen::MatrixXd said =
        Eigen::MatrixXd::Zero(model.options.partition.parts, static_cast<Eigen::Index>(model.mesh_of.size()));
    for (std::size_t i = 0; i < model.mesh_of.size(); ++i)
        said(model.part_of_patch[i], static_cast<Eigen::Index>(i)) = model.places.area[i];
    return said;
}

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

/// The patches [first, first + count), those of `mesh`, beside the known ones; without links and scores.
AddedMesh added_mesh(const AssignInput& input, const KnownMeshes& known, const MeshDescription& mesh,
                     int first, int count) {
    const RunModel& model = known.model;
    const auto patches = static_cast<int>(model.mesh_of.size());
    AddedMesh added;
    added.neighbors = neighbors_of(mesh, patches);
    added.overlaps = overlaps_of(mesh, patches);
    added.mesh_of = model.mesh_of;
    added.mesh_of.insert(added.mesh_of.end(), at(count), static_cast<int>(model.mesh_names.size()));
    added.patch_area = model.places.area;
    const auto areas = input.features.patch_area.begin() + first;
    added.patch_area.insert(added.patch_area.end(), areas, areas + count);
    added.known_parts = model.part_of_patch;
    added.said = input.examples.empty() ? Eigen::MatrixXd::Zero(model.options.partition.parts, count)
                                        : Eigen::MatrixXd(input.examples.area.middleCols(first, count));
    return added;
}

/// The links of the new patches, which are those from number model.mesh_of.size() on, to the run's, by area.
LinkedPoints linked_points(const RunModel& model, const SparseRows& links, const std::vector<double>& area,
                           const Eigen::Matrix3Xd& own) {
    const std::size_t patches = model.mesh_of.size();
    const auto first = at(links.offsets[patches]);
    const auto count = std::ssize(links.values) - static_cast<std::ptrdiff_t>(first);
    LinkedPoints points{Eigen::Matrix3Xd(3, count), Eigen::Matrix3Xd(3, count), Eigen::VectorXd(count)};
    Eigen::Index next = 0;
    for (Eigen::Index i = 0; i < own.cols(); ++i) {
        const std::size_t row = patches + at(i);
        for (auto k = at(links.offsets[row]); k < at(links.offsets[row + 1]); ++k, ++next) {
            points.own.col(next) = own.col(i);
            points.other.col(next) = model.places.positions.col(links.columns[k]);
            points.weight[next] = area[row] * links.values[k];
        }
    }
    const double total = points.weight.sum();
    if (total > 0.0) points.weight /= total;
    return points;
}

/// The run's patches, and then those of the new mesh.
Eigen::Matrix3Xf joined_positions(const RunModel& model, const Eigen::Matrix3Xd& own) {
    Eigen::Matrix3Xf positions(3, model.places.positions.cols() + own.cols());
    positions << model.places.positions.cast<float>(), own.cast<float>();
    return positions;
}

}  // namespace

KnownMeshes known_meshes(const RunModel& model, const std::vector<Descriptor>& descriptors) {
    const SinglePrecisionFeatures features(Comm(MPI_COMM_SELF), FeatureMatrices(model.histograms));
    const PatchPlaces& places = model.places;
    const PatchLooks looks{features, places_count(model) ? &places.positions : nullptr, places.frame,
                           places.area, model.mesh_of};
    const PartRegression regression(looks, places.neighbors, {});
    const double segmentations =
        static_cast<double>(model.mesh_names.size()) * model.options.description.oversegmentations;
    const double share = share_weight(static_cast<double>(model.mesh_of.size()) / segmentations);
    return {model, regression.reduction(), regression.learnt({{}, said_areas(model), {}}),
            explained_weights(descriptors, share, places_count(model))};
}

MeshOutcome assign_mesh(const Comm& self, const MeshDescription& mesh, const AssignInput& input,
                        const KnownMeshes& known, const OptimiseOptions& options) {
    const int first = input.collection.numbering.first(mesh.mesh, 0);
    const int count = input.collection.numbering.count(mesh.mesh);
    const auto patches = static_cast<Eigen::Index>(known.model.mesh_of.size());
    const SubspaceProblem problem = problem_of(self, known.model, input.features, first, count);
    const SolveOptions solve{
        .gap = options.gap, .max_iterations = options.max_iterations, .max_seconds = options.max_seconds};
    const SolveResult result = solve_subspace(self, problem, solve);
    MeshOutcome outcome;
    outcome.figures = {
        mesh.mesh, own_share(result, input.features, first, count), allowed_pair_count(problem), {}};
    AddedMesh added = added_mesh(input, known, mesh, first, count);
    added.links = normalized_links(self, result.coefficients);
    if (added.links.values.empty()) {
        throw Error(ExitCode::input, input.collection.meshes[at(mesh.mesh)].path +
                                         ": it has nothing in common with the run's shapes; leave it out");
    }
    const SinglePrecisionFeatures features(self, problem.features);
    const Eigen::Matrix3Xd as_in_file = input.features.positions.middleCols(first, count);
    // Also where places do not count: pictures and alignment.json show how the shape stands.
    LinkedPoints places;
    if (known.model.places.shapes.agreement > 0.0)
        places = linked_points(known.model, added.links, added.patch_area, as_in_file);
    outcome.figures.pose = added_pose(places, known.model.places.shapes, mesh.key);
    const Eigen::Matrix3Xd own_positions = turned_positions(outcome.figures.pose.pose, as_in_file);
    const Eigen::Matrix3Xf positions = joined_positions(known.model, own_positions);
    const std::vector<ChoiceDescriptor> descriptors = choice_descriptors(features, positions, known.weights);
    added.descriptors = descriptors;
    const SinglePrecisionFeatures::ConstBlock all = features.all();
    added.scores = known.score(known.reduction({all.data() + all.outerStride() * patches, all.rows(), count,
                                                Eigen::OuterStride<>(all.outerStride())},
                                               places_count(known.model) ? &own_positions : nullptr,
                                               neighbors_of(mesh, 0)));
    outcome.scores = added.scores.cast<float>();
    outcome.parts = added_parts(added, weights_of_choice(known.model.options.description.oversegmentations),
                                ExampleWeights());
    return outcome;
}

}  // namespace coseg
