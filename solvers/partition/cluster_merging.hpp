#pragma once
// Merges clusters until only as many are left as there are parts.

#include <Eigen/Core>
#include <vector>

#include "solvers/affinity/sparse_rows.hpp"
#include "src/parallel/comm.hpp"
#include "src/records/start_outcome.hpp"

namespace coseg {

/// The links between clusters in an affinity.
struct ClusterLinks {
    Eigen::MatrixXd links;   ///< clusters x clusters, symmetric: sum of S_ij over i in a, j in b
    Eigen::VectorXd volume;  ///< sum of degrees in a cluster: the row sums of links
};

/// Sums the links of the clusters that `labels` describe: 0 .. clusters-1 for each patch, the same on all
/// ranks. Sums are taken in the order of patches. Collective.
ClusterLinks cluster_links(const Comm& comm, const SparseRows& affinity, const std::vector<int>& labels,
                           int clusters);

/// The share of each mesh's area that lies in a cluster: clusters x meshes, each column sums to 1.
/// `patch_area` and `mesh_of` are per patch, with meshes 0 .. M-1.
Eigen::MatrixXd area_shares(const std::vector<int>& labels, int clusters,
                            const std::vector<double>& patch_area, const std::vector<int>& mesh_of);

/// Merges pairs of clusters by the rule, one after the other, until `parts` are left. Of equal pairs the one
/// with the lowest numbers is taken. Clusters without a patch do not count. Returns the part of each cluster,
/// 0 .. parts-1 in the order of their lowest clusters, and -1 for an empty cluster. There are fewer parts
/// where fewer clusters have patches.
std::vector<int> merge_clusters(ClusterLinks links, const std::vector<int>& cluster_sizes, int parts,
                                MergeRule rule);

}  // namespace coseg
