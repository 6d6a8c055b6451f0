#pragma once
// Vertices that a file repeats at one place, made one again.

#include <vector>

#include "src/mesh/polygon_mesh.hpp"

namespace coseg {

/// Per vertex the number of the vertex that stands for it: the lowest one with equal coordinates (-0 equals
/// 0). Only vertices that may be welded take part: those on an edge with a single face (seams of exported
/// textures and normals, polygon soups), and those joined by an edge without length. So a closed mesh keeps
/// its vertices, and closed parts that touch stay apart.
std::vector<int> weld_vertices(const PolygonMesh& mesh);

}  // namespace coseg
