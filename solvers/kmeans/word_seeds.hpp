#pragma once
// Chooses starting words for k-means.

#include <Eigen/Core>
#include <cstdint>

namespace coseg {

/// d x K starting words, K <= words, from the rows of `points` (n x d, column major: one coordinate of all
/// points after the other). The first word is drawn uniformly, each next one with probability proportional to
/// the squared distance to the nearest word so far. K < words only if there are fewer distinct points; K = 0
/// without points. The result is a function of the values and the order of the points and of the seed alone.
/// Source: Arthur and Vassilvitskii 2007 (k-means++).
Eigen::MatrixXf word_seeds(const Eigen::MatrixXf& points, int words, std::uint64_t seed);

}  // namespace coseg
