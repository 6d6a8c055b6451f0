#include "mpi_drivers/optimise/optimise_stage.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "solvers/subspace/mesh_links.hpp"
#include "solvers/variants/subspace_variants.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/base/text.hpp"

namespace coseg {

namespace {

/// In how many other meshes a patch may have matches, at most.
int links_of(const LinkChoice& links, int meshes) {
    constexpr int all = std::numeric_limits<int>::max();
    switch (links.rule) {
        case LinkChoice::Rule::all:
            return all;
        case LinkChoice::Rule::automatic:
            return meshes <= meshes_linked_to_all ? all : default_links;
        case LinkChoice::Rule::number:
            break;
    }
    return links.meshes;
}

void refuse_contradictions(const OptimiseOptions& options) {
    const bool over_all_pairs = options.scope != PenaltyScope::meshes || !keeps_scope(options.variant);
    if (over_all_pairs && options.links.rule == LinkChoice::Rule::number) {
        throw Error(ExitCode::usage,
                    "--links " + to_string(options.links) +
                        ": links to some meshes only need --scope meshes and a variant that keeps it; "
                        "row scope, ssc and ssqp are over all pairs");
    }
}

/// The place of --feature among the features at hand.
int chosen_feature(const PatchFeatures& features, const OptimiseOptions& options) {
    if (options.variant != SubspaceVariant::single_feature) return 0;
    for (std::size_t h = 0; h < features.descriptors.size(); ++h) {
        if (features.descriptors[h].name == options.feature) return static_cast<int>(h);
    }
    throw AgreedError(ExitCode::usage, "--feature " + options.feature +
                                           ": its weight is 0; give it a positive one in --feature-weights");
}

std::vector<std::string> feature_labels(const PatchFeatures& features, const OptimiseOptions& options) {
    if (options.variant == SubspaceVariant::single_feature) return {options.feature};
    if (options.variant != SubspaceVariant::multi_feature && options.variant != SubspaceVariant::independent)
        return {"concatenated"};
    std::vector<std::string> labels;
    for (const Descriptor& descriptor : features.descriptors) labels.push_back(descriptor.name);
    return labels;
}

}  // namespace

SubspaceProblem subspace_problem(const Collection& collection, const OptimiseOptions& options) {
    SubspaceProblem problem;
    problem.alpha = options.alpha;
    problem.beta = options.beta;
    problem.lambda = options.lambda;
    // One mesh has no other mesh to link to: its patches are then compared among themselves.
    const bool mesh_scope = options.scope == PenaltyScope::meshes && collection.meshes.size() > 1;
    problem.scope = mesh_scope && keeps_scope(options.variant) ? PenaltyScope::meshes : PenaltyScope::rows;
    problem.mesh_of = collection.numbering.mesh_of();
    if (problem.scope == PenaltyScope::meshes) {
        std::vector<std::string> names;
        for (const MeshFacts& mesh : collection.meshes) names.push_back(mesh.name);
        problem.allowed_meshes =
            mesh_links(names, links_of(options.links, static_cast<int>(names.size())), options.seed);
    }
    return problem;
}

SolveOptions solve_options(const OptimiseOptions& options) {
    return {.gap = options.gap,
            .max_iterations = options.max_iterations,
            .max_seconds = options.max_seconds,
            .solver = options.solver};
}

Optimisation optimise(const Comm& comm, const Collection& collection, const PatchFeatures& features,
                      const OptimiseOptions& options, SolverCheckpoint* checkpoint, StageLog* log) {
    agree(comm, [&] { refuse_contradictions(options); });
    const int feature = chosen_feature(features, options);
    SubspaceProblem problem = subspace_problem(collection, options);
    problem.features = features.histograms;
    Optimisation done;
    done.variant = to_string(options.variant);
    done.scope = to_string(problem.scope);
    done.links = static_cast<int>(collection.meshes.size()) - 1;
    if (!problem.allowed_meshes.empty()) {
        done.links = 0;
        for (const std::vector<int>& allowed : problem.allowed_meshes)
            done.links = std::max(done.links, static_cast<int>(allowed.size()));
    }
    done.allowed_pairs = allowed_pair_count(problem);
    SolveOptions solve = solve_options(options);
    solve.checkpoint = checkpoint;
    solve.progress = [log](std::int64_t columns, std::int64_t all) {
        if (log != nullptr) log->progress(columns, all);
    };
    done.result = solve_variant(comm, problem, options.variant, feature, solve);
    done.features = feature_labels(features, options);
    return done;
}

std::string describe(const Optimisation& optimisation) {
    const SolveResult& result = optimisation.result;
    return std::to_string(result.nonzero_groups) + " of " + std::to_string(optimisation.allowed_pairs) +
           " allowed pairs, gap over these " + significant(result.relative_gap) + " (" +
           to_string(result.reason) + ")";
}

}  // namespace coseg
