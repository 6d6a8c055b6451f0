#pragma once
// Splits a collection into overlapping subsets that have some shapes in common.

#include <cstdint>
#include <string>
#include <vector>

namespace coseg {

struct OverlappingSubsets {
    std::vector<int> common;                ///< meshes that are in every subset, ascending
    std::vector<std::vector<int>> subsets;  ///< all meshes of each, the common ones included, ascending
};

/// Splits meshes into subsets of at most `size` >= 4. A third of each subset (at least two meshes) are the
/// same common meshes; every other mesh is in one subset, and these are shared out evenly. A hash of the seed
/// and the names decides which meshes are common, so that their order does not matter. Where all meshes fit
/// into one subset there is just that one, and all meshes are common. Source: the paper, section 5 (Figure
/// 6).
OverlappingSubsets overlapping_subsets(const std::vector<std::string>& names, int size, std::uint64_t seed);

}  // namespace coseg
