#pragma once
// Starting words for k-means.

#include <Eigen/Core>
#include <cstdint>

namespace coseg {

/// d x K starting words, K <= words, from the rows of `points` (n x d, column major: one coordinate of all
/// points after the other): the first uniformly, each next one with probability proportional to the squared
/// distance to the nearest so far. K < words only if there are fewer distinct points; K = 0 without points.
/// A function of the points' order, values and the seed alone.
/// Source: Arthur and Vassilvitskii 2007 (k-means++).
Eigen::MatrixXf word_seeds(const Eigen::MatrixXf& points, int words, std::uint64_t seed);

}  // namespace coseg
