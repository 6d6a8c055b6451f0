#pragma once
// Gathers half-edges by the undirected edge that they lie on.

#include <vector>

namespace coseg {

/// Group g holds half_edges[offsets[g] .. offsets[g+1]), ascending. Groups are ordered by the lower, then the
/// higher vertex of their edge.
struct EdgeGroups {
    std::vector<int> offsets;
    std::vector<int> half_edges;

    [[nodiscard]] int count() const noexcept { return static_cast<int>(offsets.size()) - 1; }
};

/// Half-edge h runs from vertex from[h] to vertex to[h]. Half-edges with from[h] == to[h] are left out.
/// Vertex numbers lie in 0 .. vertices-1. The time is linear except for the sorting of edges around one
/// vertex.
EdgeGroups group_edges(const std::vector<int>& from, const std::vector<int>& to, int vertices);

}  // namespace coseg
