#include "mpi_drivers/clustering.hpp"

#include <algorithm>
#include <functional>
#include <utility>

#include "mpi_drivers/optimise/solution_output.hpp"
#include "solvers/subspace/mesh_links.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/parallel/record_exchange.hpp"

namespace coseg {

namespace {

/// The certificate and the limits of allowed pairs refer to groups; without any each item is one.
SubspaceProblem make_problem(ClusterData& data, const ClusterOptions& settings) {
    SubspaceProblem problem;
    problem.features = std::move(data.features);
    problem.alpha = settings.alpha;
    problem.beta = settings.beta;
    problem.lambda = settings.lambda;
    const bool grouped =
        !data.file.mesh_of.empty() &&
        std::ranges::adjacent_find(data.file.mesh_of, std::not_equal_to()) != data.file.mesh_of.end();
    // One group has no other to link to: its items are then compared among themselves.
    const bool mesh_scope =
        settings.scope == ClusterScope::meshes || (settings.scope == ClusterScope::automatic && grouped);
    if (settings.scope == ClusterScope::meshes && !grouped) {
        throw AgreedError(ExitCode::input,
                          data.name +
                              ": --scope meshes needs the dataset 'mesh_of' with at least two "
                              "groups; items of one group are not linked to each other");
    }
    if (!mesh_scope || !keeps_scope(settings.variant)) {
        if (settings.links == 0) return problem;
        throw AgreedError(
            ExitCode::usage,
            data.name +
                ": links would have no effect; they need groups of items ('mesh_of'), the scope "
                "auto or meshes, and a variant that keeps it; row scope, ssc and ssqp are over "
                "all pairs");
    }
    problem.scope = PenaltyScope::meshes;
    problem.mesh_of = data.file.mesh_of;
    const int meshes = 1 + *std::ranges::max_element(problem.mesh_of);
    std::vector<std::string> names = data.file.mesh_names;
    for (int m = 0; names.size() < static_cast<std::size_t>(meshes); ++m) names.push_back(std::to_string(m));
    if (settings.links > 0) problem.allowed_meshes = mesh_links(names, settings.links, settings.seed);
    return problem;
}

/// What cannot be clustered, in the terms of the data.
void validate(const SubspaceProblem& problem, const ClusterData& data, const ClusterOptions& settings) {
    try {
        validate(problem);
    } catch (const Error& error) {
        throw Error(error.code(), in_terms_of(data, error.what()));
    }
    if (settings.parts > problem.size()) {
        throw Error(ExitCode::usage, std::to_string(settings.parts) + " parts are asked for, but " +
                                         data.name + " holds " + std::to_string(problem.size()) +
                                         (problem.size() == 1 ? " item" : " items"));
    }
}

/// Collective.
void scale_columns(FeatureMatrices& features) {
    const std::vector<Eigen::Index>& offsets = features.offsets();
    features.for_each_column([&](Eigen::Index, double* column) {
        for (std::size_t h = 0; h < features.size(); ++h) {
            Eigen::Map<Eigen::VectorXd> x(column + offsets[h], offsets[h + 1] - offsets[h]);
            const Eigen::VectorXd aligned = x;  // for its sum not to depend on where the column lies
            const double norm = aligned.norm();
            if (norm > 0.0) x /= norm;
        }
    });
}

}  // namespace

std::string in_terms_of(const ClusterData& data, const std::string& message) {
    std::string names;
    for (const std::string& name : data.file.names) names += (names.empty() ? "" : ", ") + name;
    return data.name + ": " + message + " (features are the datasets of 'features' in the order " + names +
           ", columns their rows, both counted from 1)";
}

void share(const Comm& comm, ClusterData& data) {
    broadcast(comm, data.file.names);
    try {
        data.features = share_matrices(comm, data.file.features);
    } catch (const AgreedError& error) {
        throw AgreedError(error.code(), in_terms_of(data, error.what()));
    }
    data.file.features.clear();
    broadcast(comm, data.file.mesh_of);
    broadcast(comm, data.file.patch_area);
    broadcast(comm, data.file.mesh_names);
}

SolvedClusters solve_clusters(const Comm& comm, ClusterData& data, const ClusterOptions& settings) {
    SolvedClusters solved;
    solved.problem = make_problem(data, settings);
    agree(comm, [&] { validate(solved.problem, data, settings); });
    if (settings.unit_columns) scale_columns(solved.problem.features);
    solved.solution = solve_variant(comm, solved.problem, settings.variant, 0, settings.solve);
    return solved;
}

CutResult cut_clusters(const Comm& comm, const ClusterData& data, const SolveResult& solution,
                       const ClusterOptions& settings) {
    const FeatureFile& file = data.file;
    if (settings.parts > 1) refuse_empty_solution(solution, data.name);
    const auto items = static_cast<std::size_t>(solution.coefficients.size);
    std::vector<GlobalPatchNeighbors> neighbors;
    for (std::size_t k = 0; k < file.neighbors.first.size(); ++k) {
        neighbors.push_back(
            {file.neighbors.first[k], file.neighbors.second[k], file.neighbors.weight[k], file.concavity[k]});
    }
    std::vector<GlobalPatchOverlap> overlaps;
    for (std::size_t k = 0; k < file.overlaps.first.size(); ++k)
        overlaps.push_back({file.overlaps.first[k], file.overlaps.second[k], file.overlaps.weight[k]});
    const std::vector<int> mesh_of = file.mesh_of.empty() ? std::vector<int>(items, 0) : file.mesh_of;
    const std::vector<double> area = file.patch_area.empty()
                                         ? std::vector<double>(items, 1.0 / static_cast<double>(items))
                                         : file.patch_area;
    CutOptions options;
    options.parts = settings.parts;
    options.form = settings.affinity;
    options.minima_rule = any_rank(comm, !neighbors.empty());
    options.starts = single_start(settings.parts, settings.adjacency);
    return partition_patches(comm, {solution.coefficients, neighbors, overlaps, mesh_of, area}, options);
}

}  // namespace coseg
