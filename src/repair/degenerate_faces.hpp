#pragma once
// Triangles without area, taken out without opening the surface where that can be avoided.

#include <Eigen/Core>
#include <vector>

namespace coseg {

/// Triangles on their way to a working mesh, each with the input face it came from.
struct WorkingTriangles {
    std::vector<Eigen::Vector3i> triangles;
    std::vector<int> input_face;
};

/// A triangle is degenerate if it repeats a vertex or if its height over its longest edge is at most this
/// share of that edge: rounding in double precision, far below what single-precision files can express.
inline constexpr double degenerate_height = 1e-12;

bool is_degenerate(const Eigen::Vector3i& triangle, const std::vector<Eigen::Vector3d>& positions);

/// Removes degenerate triangles; returns how many. Where such a triangle's middle vertex lies on the edge of
/// one neighbour, that neighbour is split at it, so that the surface stays closed.
int remove_degenerate(WorkingTriangles& working, const std::vector<Eigen::Vector3d>& positions);

}  // namespace coseg
