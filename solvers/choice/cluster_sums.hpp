#pragma once
// What the objective of a partition needs to know of clusters of patches, so that unions of clusters are
// valued without looking at their patches.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "solvers/choice/partition_objective.hpp"

namespace coseg {

/// Sums over the patches of C clusters in M meshes.
struct ClusterSums {
    /// Per mesh C x C: inner products, by PartitionObjective::per_mesh, of the clusters' deviations in it.
    std::vector<Eigen::MatrixXd> per_mesh;
    Eigen::MatrixXd pooled;  ///< C x C: the same by PartitionObjective::pooled, of the sums over all meshes
    Eigen::MatrixXd ties;    ///< C x C: gains of pairs of patches, half of each pair in either place
    Eigen::MatrixXd area;    ///< C x M
    Eigen::MatrixXd share;   ///< C x M: of the mesh's area
    double size_weight = 0.0;

    [[nodiscard]] int count() const noexcept { return static_cast<int>(area.rows()); }
};

/// labels: 0 .. clusters-1 for each patch.
ClusterSums cluster_sums(const PartitionObjective& objective, const std::vector<int>& labels, int clusters);

/// The value of the part that consists of the clusters `members`; 0 for none.
double value_of_part(const ClusterSums& sums, std::span<const int> members);

/// The value of all clusters as parts.
double value_of_parts(const ClusterSums& sums);

/// Cluster b becomes one with cluster a, and the last cluster takes its number b.
void unite(ClusterSums& sums, int a, int b);

}  // namespace coseg
