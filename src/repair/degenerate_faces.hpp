#pragma once
// Removes triangles without area, and keeps the surface closed where that is possible.

#include <Eigen/Core>
#include <vector>

namespace coseg {

/// Triangles from which a working mesh will be made, each with the input face that it came from.
struct WorkingTriangles {
    std::vector<Eigen::Vector3i> triangles;
    std::vector<int> input_face;
};

/// A triangle is degenerate if it repeats a vertex, or if its height over its longest edge is at most this
/// share of that edge. The share is that of rounding in double precision, far below what single-precision
/// files can express.
inline constexpr double degenerate_height = 1e-12;

bool is_degenerate(const Eigen::Vector3i& triangle, const std::vector<Eigen::Vector3d>& positions);

/// Removes degenerate triangles and returns their number. Where the middle vertex of such a triangle lies on
/// the edge of a neighbour, the neighbour is split at this vertex, so that the surface stays closed.
int remove_degenerate(WorkingTriangles& working, const std::vector<Eigen::Vector3d>& positions);

}  // namespace coseg
