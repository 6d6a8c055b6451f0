#pragma once
// A collection split into overlapping subsets with common shapes.

#include <cstdint>
#include <string>
#include <vector>

namespace coseg {

struct OverlappingSubsets {
    std::vector<int> common;                ///< meshes that are in every subset, ascending
    std::vector<std::vector<int>> subsets;  ///< all meshes of each, the common ones included, ascending
};

/// Splits meshes into subsets of at most `size` >= 4, a third of each (at least two) the same common meshes; the others
/// are in one subset each, dealt evenly. Which are common is a hash of the seed and the names, so that it does not depend on
/// their order. One subset of all, and all common, where they fit into one. Source: the paper, section 5 (Figure 6).
OverlappingSubsets overlapping_subsets(const std::vector<std::string>& names, int size, std::uint64_t seed);

}  // namespace coseg
