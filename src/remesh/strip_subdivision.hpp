#pragma once
// Cuts long thin triangles into short ones, without the many that halving edges makes of a needle.

#include <optional>

#include "src/mesh/tri_mesh.hpp"

namespace coseg {

/// Cuts every edge into the fewest equal pieces of at most longest_edge, and every face into a strip of
/// triangles between the pieces of its longest edge and those of the other two. The surface does not
/// move, and stays as manifold, oriented and closed as it was. A face whose edges have p, q and r pieces
/// gives p + q + r - 2 triangles. Halving the longest edge again and again would give (length /
/// longest_edge)^1.58 of a needle: each halving leaves three needles of half the length. Triangles are
/// long only across a face that is wide itself. New vertices come last. Nothing if there would be more
/// than most_faces. longest_edge > 0.
std::optional<TriMesh> cut_into_strips(const TriMesh& mesh, double longest_edge, int most_faces);

}  // namespace coseg
