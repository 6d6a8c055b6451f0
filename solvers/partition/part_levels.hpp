#pragma once
// One nested tree of parts for a whole collection, with coarser and finer levels than the partition.

#include <vector>

#include "solvers/choice/cluster_sums.hpp"
#include "solvers/choice/partition_objective.hpp"
#include "solvers/partition/nested_levels.hpp"
#include "src/records/part_tree.hpp"

namespace coseg {

/// The tree of clusters in place of patches. Clusters lie inside parts: part_of_cluster, 0 .. K-1, each of
/// which occurs. Again and again the pair that loses least by it is united: inside the parts down to `finest`
/// pieces, which are the finest level, and on to K; then between parts, down to 2. K and `finest` are at
/// least 2. Serial; a function of the arguments alone.
///
/// With `levels`, as nested_levels() gives them but for clusters, those unions are made that lead to these
/// levels, whatever they lose; only levels finer than the finest of them are found as above, inside its
/// parts.
PartTree part_tree(ClusterSums clusters, const std::vector<int>& part_of_cluster, int finest,
                   const PartitionsByNumber& levels = {});

/// The label of each piece at the level of `count` parts, 0 .. count-1, where count is 2 to tree.finest().
/// Labels of a level finer than K are those of K and further ones; below K the numbers close ranks.
std::vector<int> labels_at_level(const PartTree& tree, int count);

}  // namespace coseg
