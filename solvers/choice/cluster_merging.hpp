#pragma once
// Merges clusters until only as many are left as there are parts, guided by the objective of the partition.

#include <vector>

#include "solvers/choice/cluster_sums.hpp"

namespace coseg {

/// Several results, each with the part of each cluster, 0 .. parts-1, such that the sum of the parts' values
/// is large. Pairs are united one after the other, with the best `merging_beam` partial results kept at each
/// step. Each result then takes the best of two kinds of moves as long as one gains: a cluster goes to
/// another part; or two parts become one, and one cluster leaves its part to be a new one. Where a part is
/// then hardly one (is_degenerate_part), moves go on with such parts counted as worse than any other. There
/// are fewer parts where there are fewer clusters. Serial; a function of the sums alone.
///
/// Deviates: the paper's code cuts into K parts at once. Source: none; the objective is in
/// partition_objective.hpp.
std::vector<std::vector<int>> merge_clusters(const ClusterSums& clusters, int parts);

/// Partial results kept at each step: 4, where there are fewer than 30 clusters, and 2 otherwise.
int merging_beam(int clusters);

}  // namespace coseg
