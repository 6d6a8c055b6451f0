#pragma once
// The edges of a triangle mesh as a sorted list. Everything that walks over edges begins with it.

#include <vector>

#include "src/mesh/tri_mesh.hpp"

namespace coseg {

/// One side of an edge: the edge low - high as face `face` sees it.
struct HalfEdge {
    int low = -1;  ///< vertices, low < high
    int high = -1;
    int face = -1;
    bool forward = false;  ///< the face runs from low to high
};

/// All 3 F half-edges, sorted by (low, high, face), so that the two sides of an inner edge are adjacent
/// entries.
std::vector<HalfEdge> sorted_half_edges(const TriMesh& mesh);

/// Whether the two sides belong to one edge that two faces share.
[[nodiscard]] inline bool share_edge(const HalfEdge& x, const HalfEdge& y) noexcept {
    return x.low == y.low && x.high == y.high && x.face != y.face;
}

}  // namespace coseg
