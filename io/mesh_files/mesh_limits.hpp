#pragma once
// What a mesh file may hold at most, and the sentences about what it may not, alike for all formats.

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

namespace coseg {

/// Pictures, PLY and VTP files hold coordinates in single precision, which ends at 3.4e38, and squares of
/// lengths must stay finite in double precision.
inline constexpr double largest_coordinate = 1e37;

/// Vertices are numbered by int.
inline constexpr std::int64_t most_vertices = std::numeric_limits<int>::max();

/// Corners of all faces together, so that half-edges and what else is counted per corner can be numbered by
/// int.
inline constexpr std::int64_t most_corners = 700'000'000;

/// False for infinity and what is not a number, too.
inline bool is_usable_coordinate(double value) { return std::abs(value) <= largest_coordinate; }

/// What is wrong with a coordinate of vertex `vertex` for which is_usable_coordinate is false.
std::string bad_coordinate(std::int64_t vertex, double value);

/// "face 7 refers to vertex 12, but there are 8 vertices (counted from 0) ...".
std::string bad_index(std::int64_t face, std::int64_t index, std::int64_t vertices);

/// What is wrong with a mesh beyond most_vertices or most_corners.
inline constexpr const char* too_many_vertices = "the mesh has too many vertices; split it";
inline constexpr const char* too_many_corners = "the mesh has too many corners; split it";

}  // namespace coseg
