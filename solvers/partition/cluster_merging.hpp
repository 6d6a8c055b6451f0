#pragma once
// More clusters than parts, merged down to the parts.

#include <Eigen/Core>
#include <vector>

#include "solvers/affinity/sparse_rows.hpp"
#include "src/parallel/comm.hpp"
#include "src/records/start_outcome.hpp"

namespace coseg {

/// How clusters hang together in an affinity.
struct ClusterLinks {
    Eigen::MatrixXd links;   ///< clusters x clusters, symmetric: sum of S_ij over i in a, j in b
    Eigen::VectorXd volume;  ///< sum of degrees in a cluster: the row sums of links
};

/// Labels 0 .. clusters - 1 per patch, the same on all ranks. Sums are taken in the order of patches.
/// Collective.
ClusterLinks cluster_links(const Comm& comm, const SparseRows& affinity, const std::vector<int>& labels,
                           int clusters);

/// How much of each mesh's area lies in a cluster: clusters x meshes, each column sums to 1. `patch_area` and
/// `mesh_of` per patch, meshes 0 .. M-1.
Eigen::MatrixXd area_shares(const std::vector<int>& labels, int clusters,
                            const std::vector<double>& patch_area, const std::vector<int>& mesh_of);

/// Merges two clusters after the other by the rule (ties: lowest numbers) until `parts` are left. Clusters without a
/// patch do not count. Returns the part of each cluster, 0 .. parts - 1 in the order of their lowest clusters; -1 for an
/// empty cluster. Fewer parts where fewer clusters have patches.
std::vector<int> merge_clusters(ClusterLinks links, const std::vector<int>& cluster_sizes, int parts,
                                MergeRule rule);

}  // namespace coseg
