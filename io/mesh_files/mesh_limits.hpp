#pragma once
// The limits of what a mesh file may hold, and the sentences about what is beyond them, which are the same
// for all formats.

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

/// Whether the coordinate is within the limit; false also for infinity and for what is not a number.
inline bool is_usable_coordinate(double value) { return std::abs(value) <= largest_coordinate; }

/// The sentence about a coordinate of vertex `vertex` for which is_usable_coordinate is false.
std::string bad_coordinate(std::int64_t vertex, double value);

/// "face 7 refers to vertex 12, but there are 8 vertices (counted from 0) ...".
std::string bad_index(std::int64_t face, std::int64_t index, std::int64_t vertices);

/// The sentences about a mesh beyond most_vertices or most_corners.
inline constexpr const char* too_many_vertices = "the mesh has too many vertices; split it";
inline constexpr const char* too_many_corners = "the mesh has too many corners; split it";

}  // namespace coseg
