#pragma once
// One planar or nearly planar polygon cut into triangles.

#include <Eigen/Core>
#include <vector>

namespace coseg {

/// Polygons with more corners than this are cut as a fan even where they are concave: ear clipping is
/// quadratic.
inline constexpr int max_ear_clipping_corners = 2000;

/// Triangles as positions 0 .. n-1 in the list of corners, n - 2 of them for n >= 3 (none for fewer), in the
/// polygon's own orientation. Quads take the shorter diagonal inside; convex polygons are a fan about corner
/// 0; others are ear-clipped in the plane of Newell's normal. Always ends, whatever the shape (a polygon that
/// crosses itself gives some triangles, not good ones).
std::vector<Eigen::Vector3i> triangulate_polygon(const std::vector<Eigen::Vector3d>& corners);

/// Newell's area vector: half the sum of cross products of successive corners; its length is the area of a
/// planar polygon.
Eigen::Vector3d polygon_area_vector(const std::vector<Eigen::Vector3d>& corners);

}  // namespace coseg
