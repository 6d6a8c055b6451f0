#pragma once
// Clusters the items of feature matrices: the optimiser, the affinity and the cut, on data that need not be
// shapes.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "io/data_files/feature_file.hpp"
#include "solvers/affinity/affinity.hpp"
#include "solvers/partition/patch_partition.hpp"
#include "solvers/variants/subspace_variants.hpp"
#include "src/base/enum_names.hpp"
#include "src/histograms/feature_matrices.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

enum class ClusterScope {
    automatic,  ///< meshes where the file groups its items
    rows,
    meshes,
};
constexpr std::array<EnumName<ClusterScope>, 3> enum_names(ClusterScope /*type*/) {
    return {{{ClusterScope::automatic, "auto"},
             {ClusterScope::rows, name_of(PenaltyScope::rows)},
             {ClusterScope::meshes, name_of(PenaltyScope::meshes)}}};
}
constexpr std::array<EnumName<ClusterScope>, 2> enum_aliases(ClusterScope /*type*/) {
    return {{{ClusterScope::rows, "paper"}, {ClusterScope::meshes, "mesh"}}};
}

/// What the items are compared by, and when it is well enough.
struct ClusterOptions {
    int parts = 0;
    bool unit_columns = false;  ///< every column of every feature is scaled to norm 1 first
    SubspaceVariant variant = SubspaceVariant::multi_feature;
    ClusterScope scope = ClusterScope::automatic;
    int links = 0;
    std::uint64_t seed = 1;
    double alpha = 0.01, beta = 0.1, lambda = 1.0;
    AffinityForm affinity = AffinityForm::formula_8;
    double adjacency = 0.0;
    SolveOptions solve{.gap = 1e-4};
};

/// The items: FeatureFile without its matrices, which all ranks hold, and what messages call it. Relations
/// are on rank 0 alone.
struct ClusterData {
    FeatureFile file;
    FeatureMatrices features;
    std::string name;
};

/// A message about matrices, in the terms of the data.
std::string in_terms_of(const ClusterData& data, const std::string& message);

/// Moves the root's matrices in data.file.features to data.features on all ranks, and gives all ranks what
/// else each needs. Collective; throws AgreedError(input) where the matrices do not fit together.
void share(const Comm& comm, ClusterData& data);

struct SolvedClusters {
    SubspaceProblem problem;
    SolveResult solution;
};

/// The coefficients of the items over each other. The features are taken from `data`. Collective; throws
/// AgreedError: input where the data cannot be clustered, usage where there are fewer items than parts.
SolvedClusters solve_clusters(const Comm& comm, ClusterData& data, const ClusterOptions& settings);

/// The part of every item. Collective; throws AgreedError(input) where W = 0 leaves nothing to cut.
CutResult cut_clusters(const Comm& comm, const ClusterData& data, const SolveResult& solution,
                       const ClusterOptions& settings);

}  // namespace coseg
