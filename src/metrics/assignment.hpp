#pragma once
// Finds the best one-to-one assignment of rows to columns (linear sum assignment).

#include <Eigen/Core>
#include <vector>

namespace coseg {

/// Assigns rows to columns, each to at most one, so that the sum of the gains of the pairs is largest. gain:
/// R x C, finite, any sign; min(R, C) pairs are made even where a gain is negative. Returns for each row its
/// column, or -1 for the R - C rows left over when R > C. Where several assignments are best, the answer
/// depends on the gains alone. O(min(R, C)^2 max(R, C)). Source: the Hungarian method (Kuhn 1955) as
/// successive shortest augmenting paths (Jonker and Volgenant 1987).
std::vector<int> best_assignment(const Eigen::MatrixXd& gain);

}  // namespace coseg
