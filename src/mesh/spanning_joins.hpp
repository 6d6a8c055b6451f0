#pragma once
// Finds the shortest way to join groups of points: a minimum spanning tree over the groups.

#include <Eigen/Core>
#include <vector>

namespace coseg {

/// The nearest pair of two groups.
struct PointJoin {
    int point_a = -1;  ///< point_a < point_b
    int point_b = -1;
    double distance = 0.0;
};

/// Joins the groups of a point set by the minimum spanning tree in which the distance of two groups is that
/// of their nearest points. Of pairs at the same distance the one with the lowest points is taken, so that
/// the answer is unique. points: 3 x P, finite. group: P numbers in 0 .. groups-1, each group non-empty.
/// Returns groups - 1 joins, sorted by (point_a, point_b).
/// Source: Boruvka's rounds over a k-d tree whose nodes know whether they lie inside one group (March, Ram,
/// Gray 2010, "Fast Euclidean minimum spanning tree", KDD).
/// Deviates: one tree is searched, where the source compares two trees with each other.
std::vector<PointJoin> spanning_joins(const Eigen::Matrix3Xd& points, const std::vector<int>& group,
                                      int groups);

}  // namespace coseg
