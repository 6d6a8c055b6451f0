#pragma once
// Measures how much each feature says about the parts: the figures behind the paper's Figure 4.

#include <cstdint>
#include <vector>

#include "solvers/subspace/coefficients.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

struct FeatureStrength {
    /// parts x H: the share of each feature in the coefficients inside a part; sums to 1, or all 0.
    std::vector<std::vector<double>> of_part;
    std::vector<double> overall;  ///< H: the same over all pairs
    /// parts x parts: share of all coefficients (norm of a pair) whose row lies in the first part and whose
    /// column in the second; sums to 1, or all 0.
    std::vector<std::vector<double>> blocks;
    std::vector<double> inside;  ///< parts: share of the coefficients of a part's columns that stay inside it
    /// H + 1: [k] is the number of pairs with k nonzero features; [0] is 0.
    std::vector<std::int64_t> pairs_by_features;
};

/// `part_of_patch`: 0 .. parts-1 for all patches, on all ranks. Sums are taken in the order of columns, so
/// that they are the same on any number of ranks. Collective. Source: the paper, Figure 4.
FeatureStrength feature_strength(const Comm& comm, const SparseCoefficients& coefficients,
                                 const std::vector<int>& part_of_patch, int parts);

}  // namespace coseg
