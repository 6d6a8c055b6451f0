#pragma once
// The edges of polygons, and the pieces that polygons form along them.

#include <vector>

#include "src/mesh/polygon_mesh.hpp"

namespace coseg {

/// One half-edge for each corner, from that corner to the next of its face.
struct PolygonHalfEdges {
    std::vector<int> from;
    std::vector<int> to;
    std::vector<int> face;
};

/// vertex_of: per vertex the one that stands for it.
PolygonHalfEdges polygon_half_edges(const PolygonMesh& mesh, const std::vector<int>& vertex_of);

/// Per face the lowest face of its piece. Faces with a common edge, over stand-ins, are in one piece,
/// whichever way each runs and however many faces the edge has.
std::vector<int> polygon_pieces(const PolygonMesh& mesh, const std::vector<int>& vertex_of);

}  // namespace coseg
