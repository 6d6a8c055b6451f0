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

/// What --links stands for.
int links_of(const std::string& links, int meshes) {
    if (links == "all") return std::numeric_limits<int>::max();
    if (links == "auto")
        return meshes <= meshes_linked_to_all ? std::numeric_limits<int>::max() : default_links;
    return std::stoi(links);
}

void refuse_contradictions(const RunOptions& options) {
    const SubspaceVariant variant = variant_of(options.variant);
    const bool over_all_pairs = options.scope != "mesh" || !keeps_scope(variant);
    if (over_all_pairs && options.links != "auto" && options.links != "all") {
        throw Error(ExitCode::usage,
                    "--links " + options.links +
                        ": links to some meshes only need --scope mesh and a variant that keeps it; "
                        "row scope, ssc and ssqp are over all pairs");
    }
}

/// The place of --feature among the features at hand.
int chosen_feature(const PatchFeatures& features, const RunOptions& options) {
    if (variant_of(options.variant) != SubspaceVariant::single_feature) return 0;
    for (std::size_t h = 0; h < features.descriptors.size(); ++h) {
        if (features.descriptors[h].name == options.feature) return static_cast<int>(h);
    }
    throw AgreedError(ExitCode::usage, "--feature " + options.feature +
                                           ": its weight is 0; give it a positive one in --feature-weights");
}

std::vector<std::string> feature_labels(const PatchFeatures& features, const RunOptions& options) {
    const SubspaceVariant variant = variant_of(options.variant);
    if (variant == SubspaceVariant::single_feature) return {options.feature};
    if (variant != SubspaceVariant::multi_feature && variant != SubspaceVariant::independent)
        return {"concatenated"};
    std::vector<std::string> labels;
    for (const Descriptor& descriptor : features.descriptors) labels.push_back(descriptor.name);
    return labels;
}

/// The problem that the options ask for, with the meshes' names as the seed of their links; without its features.
SubspaceProblem subspace_problem(const Collection& collection, const RunOptions& options) {
    SubspaceProblem problem;
    problem.alpha = options.alpha;
    problem.beta = options.beta;
    problem.lambda = options.lambda;
    // One mesh has no other mesh to link to: its patches are then compared among themselves.
    const bool mesh_scope = options.scope == "mesh" && collection.meshes.size() > 1;
    problem.scope =
        mesh_scope && keeps_scope(variant_of(options.variant)) ? PenaltyScope::meshes : PenaltyScope::rows;
    problem.mesh_of = collection.numbering.mesh_of();
    if (problem.scope == PenaltyScope::meshes) {
        std::vector<std::string> names;
        for (const MeshFacts& mesh : collection.meshes) names.push_back(mesh.name);
        problem.allowed_meshes =
            mesh_links(names, links_of(options.links, static_cast<int>(names.size())), options.seed);
    }
    return problem;
}

}  // namespace

Optimisation optimise(const Comm& comm, const Collection& collection, const PatchFeatures& features,
                      const RunOptions& options, SolverCheckpoint* checkpoint, StageLog* log) {
    agree(comm, [&] { refuse_contradictions(options); });
    const int feature = chosen_feature(features, options);
    SubspaceProblem problem = subspace_problem(collection, options);
    problem.features = features.histograms;
    Optimisation done;
    done.variant = options.variant;
    done.scope = problem.scope == PenaltyScope::meshes ? "mesh" : "paper";
    done.links = static_cast<int>(collection.meshes.size()) - 1;
    if (!problem.allowed_meshes.empty()) {
        done.links = 0;
        for (const std::vector<int>& allowed : problem.allowed_meshes)
            done.links = std::max(done.links, static_cast<int>(allowed.size()));
    }
    done.allowed_pairs = allowed_pair_count(problem);
    const auto progress = [log](std::int64_t columns, std::int64_t all) {
        if (log != nullptr) log->progress(columns, all);
    };
    const SolveOptions solve{.gap = options.gap,
                             .max_iterations = options.max_iterations,
                             .max_seconds = options.max_seconds,
                             .solver = options.solver,
                             .progress = progress,
                             .checkpoint = checkpoint};
    done.result = solve_variant(comm, problem, variant_of(options.variant), feature, solve);
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
