#pragma once
// More clusters than parts, merged down to the parts.

#include <Eigen/Core>
#include <vector>

#include "solvers/sparse_rows.hpp"
#include "src/comm.hpp"

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

/// sum over clusters of links inside / volume; a cluster without volume counts 0. The normalised cut is the
/// number of clusters with volume minus this. Source: Shi and Malik 2000.
double normalized_association(const ClusterLinks& links);

/// How much of each mesh's area lies in a cluster: clusters x meshes, each column sums to 1. `patch_area` and
/// `mesh_of` per patch, meshes 0 .. M-1.
Eigen::MatrixXd area_shares(const std::vector<int>& labels, int clusters,
                            const std::vector<double>& patch_area, const std::vector<int>& mesh_of);

/// Which two clusters become one next.
enum class MergeRule {
    /// Those whose union increases the normalised cut of `links` the least.
    normalized_cut,
    /// Those with the largest closeness, links_ab / sqrt(volume_a volume_b).
    affinity,
    /// Those with the largest closeness * (1 - companionship / 2): what takes turns on different shapes is
    /// one part rather than what sits on every shape beside the other.
    alternation,
};

/// sum over meshes of the smaller share / the smaller sum of shares, in [0, 1]: 0 where a and b never occur
/// together, 1 where one always comes with at least as much of the other. `shares`: clusters x meshes.
double companionship(const Eigen::MatrixXd& shares, Eigen::Index a, Eigen::Index b);

/// Merges two clusters at a time by `rule` (ties: lowest numbers) until `parts` are left. Clusters without a
/// patch do not count. Returns the part of each cluster, 0 .. parts - 1 in the order of their lowest
/// clusters; -1 for an empty cluster. Fewer parts where fewer clusters have patches.
std::vector<int> merge_clusters(const ClusterLinks& links, const Eigen::MatrixXd& shares,
                                const std::vector<int>& cluster_sizes, int parts, MergeRule rule);

}  // namespace coseg
