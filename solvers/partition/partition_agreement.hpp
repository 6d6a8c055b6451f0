#pragma once
// How far two partitions of the same patches agree, whatever their parts are called.

#include <Eigen/Core>
#include <vector>

namespace coseg {

/// The area that part a of the first and part b of the second partition have in common: rows x columns.
/// Labels are 0 .. rows-1 and 0 .. columns-1 for each patch.
Eigen::MatrixXd common_areas(const std::vector<int>& first, int rows, const std::vector<int>& second,
                             int columns, const std::vector<double>& patch_area);

/// The adjusted Rand index of two partitions, with pairs of points of the surface in place of pairs of items;
/// `common` as above. At most 1; 1 where both are one part.
/// Source: Hubert, Arabie, Comparing partitions, Journal of Classification 2, 1985.
double adjusted_rand_index(const Eigen::MatrixXd& common);

}  // namespace coseg
