#pragma once
// Levels of a tree of parts that agree with partitions found for each number of parts by itself.

#include <vector>

namespace coseg {

/// Partitions of the same patches: entry k has the labels 0 .. k+1 of a partition into k + 2 parts, and is
/// empty where there is none.
using PartitionsByNumber = std::vector<std::vector<int>>;

/// The labels of all patches at each level from 2 to at least `parts`, again by number. The level of `parts`
/// is part_of_patch, and each level unites two parts of the next finer one.
///
/// Coarser levels: of the ways to unite parts two by two, the one with the largest sum over the levels of the
/// adjusted Rand index with the guide of the same number; 16 partial ways are kept at each step. Finer
/// levels, up to the guide of most parts: the part of a guide is cut out of a part, such that the level
/// agrees most with the guide. Empty where `parts` is 1 or where a guide of fewer parts is missing. Serial;
/// a function of the arguments alone.
///
/// Source: none. The score alone takes wrong unions: boundaries of parts that were found for another number
/// of parts are not where those of the union would be, see docs/method.md, section 7.
PartitionsByNumber nested_levels(const std::vector<int>& part_of_patch, int parts,
                                 const PartitionsByNumber& guides, const std::vector<double>& patch_area);

}  // namespace coseg
