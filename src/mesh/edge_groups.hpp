#pragma once
// Half-edges gathered by the undirected edge they lie on.

#include <vector>

namespace coseg {

/// Group g holds half_edges[offsets[g] .. offsets[g+1]), ascending; groups are ordered by (lower, higher
/// vertex).
struct EdgeGroups {
    std::vector<int> offsets;
    std::vector<int> half_edges;

    [[nodiscard]] int count() const noexcept { return static_cast<int>(offsets.size()) - 1; }
};

/// Half-edge h runs from vertex from[h] to vertex to[h]; half-edges with from[h] == to[h] are left out.
/// Vertex numbers lie in 0 .. vertices-1. Linear but for the sorting of edges around one vertex.
EdgeGroups group_edges(const std::vector<int>& from, const std::vector<int>& to, int vertices);

}  // namespace coseg
