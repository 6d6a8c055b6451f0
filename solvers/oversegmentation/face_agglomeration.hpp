#pragma once
// Groups faces bottom-up into super-faces, so that spectral cuts work on small graphs.

#include <vector>

#include "solvers/oversegmentation/weighted_graph.hpp"

namespace coseg {

/// Merges neighbouring groups, starting from single nodes, until `target` groups are left: always the pair
/// whose merging changes the sum over groups of cut / mass the least (most negative first),
///     (cut_a + cut_b - 2 c_ab) / (A_a + A_b) - cut_a / A_a - cut_b / A_b,
/// cut_a the weight of a's boundary, c_ab what a and b share. Equal values: the pair with the lowest nodes.
/// Returns the group per node, numbered 0.. by lowest node; every group is connected. Where no neighbours are
/// left to merge (a disconnected graph) there are more than `target` groups. Masses and weights > 0. Time O(E
/// log E) with a heap whose outdated entries are skipped when they surface.
std::vector<int> agglomerate(const WeightedGraph& graph, int target);

}  // namespace coseg
