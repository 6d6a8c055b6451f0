#pragma once
// Cuts one planar or nearly planar polygon into triangles.

#include <Eigen/Core>
#include <vector>

namespace coseg {

/// Polygons with more corners than this are cut as a fan even where they are concave, because ear clipping
/// takes quadratic time.
inline constexpr int max_ear_clipping_corners = 2000;

/// The triangles, as positions 0 .. n-1 in the list of corners, in the polygon's own orientation: n - 2
/// triangles for n >= 3 corners, none for fewer. A quadrilateral is cut along the shorter diagonal that lies
/// inside it. A convex polygon becomes a fan about corner 0. Others are ear-clipped in the plane of Newell's
/// normal. The function ends whatever the shape; a polygon that crosses itself gives some triangles, though
/// not good ones.
std::vector<Eigen::Vector3i> triangulate_polygon(const std::vector<Eigen::Vector3d>& corners);

/// Newell's area vector is half the sum of cross products of successive corners. Its length is the area of a
/// planar polygon.
Eigen::Vector3d polygon_area_vector(const std::vector<Eigen::Vector3d>& corners);

}  // namespace coseg
