#pragma once
// Joins vertices that a file repeats at the same coordinates.

#include <vector>

#include "src/mesh/polygon_mesh.hpp"

namespace coseg {

/// For each vertex the number of the vertex that replaces it: the lowest one with equal coordinates, where -0
/// equals 0. Two kinds of vertices take part: those on an edge that only one face has (seams of exported
/// textures and normals, polygon soups), and those joined by an edge without length. A closed mesh therefore
/// keeps its vertices, and closed parts that touch stay apart.
std::vector<int> weld_vertices(const PolygonMesh& mesh);

}  // namespace coseg
