#pragma once
// What patches gain in a part by the terms of the objective that are no ties: their derivatives.

#include <Eigen/Core>
#include <vector>

#include "solvers/choice/partition_objective.hpp"
#include "src/parallel/block_range.hpp"

namespace coseg {

/// The first derivative, at given labels, of explained shares and size steadiness in the amount of a patch
/// that is in a part.
class PartGains {
  public:
    /// labels: 0 .. parts-1 of each patch. Neither is copied.
    PartGains(const PartitionObjective& objective, const std::vector<int>& labels, int parts);

    /// parts x n, of the patches of one mesh. In a part that the mesh has nothing of, its own share of the
    /// spread counts 0.
    [[nodiscard]] Eigen::MatrixXd of_mesh(BlockRange patches) const;

  private:
    const PartitionObjective& objective_;
    const std::vector<int>& labels_;
    Eigen::MatrixXf deviations_;  ///< D x K, sums over all meshes
    Eigen::VectorXd area_;        ///< K, likewise
    Eigen::MatrixXd share_;       ///< K x M: of the mesh's area
};

}  // namespace coseg
