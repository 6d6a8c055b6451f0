#include "src/mesh/half_edges.hpp"

#include <algorithm>
#include <numeric>

#include "src/base/index.hpp"

namespace coseg {

namespace {

HalfEdge half_edge(const TriMesh& mesh, int face, int k) {
    const int a = mesh.faces(k, face);
    const int b = mesh.faces((k + 1) % 3, face);
    return {std::min(a, b), std::max(a, b), face, a < b};
}

/// Per vertex v where its half-edges, those with low == v, begin, and where the last one's end.
std::vector<int> starts_of_vertices(const TriMesh& mesh) {
    std::vector<int> starts(at(mesh.vertex_count()) + 1, 0);
    for (int f = 0; f < mesh.face_count(); ++f) {
        for (int k = 0; k < 3; ++k) ++starts[at(half_edge(mesh, f, k).low) + 1];
    }
    std::partial_sum(starts.begin(), starts.end(), starts.begin());
    return starts;
}

}  // namespace

std::vector<HalfEdge> sorted_half_edges(const TriMesh& mesh) {
    std::vector<HalfEdge> half_edges(at(mesh.face_count()) * 3);
    const std::vector<int> starts = starts_of_vertices(mesh);
    std::vector<int> next(starts.begin(), starts.end() - 1);
    for (int f = 0; f < mesh.face_count(); ++f) {
        for (int k = 0; k < 3; ++k) {
            const HalfEdge side = half_edge(mesh, f, k);
            half_edges[at(next[at(side.low)]++)] = side;
        }
    }
    for (std::size_t v = 0; v + 1 < starts.size(); ++v) {
        std::sort(half_edges.begin() + starts[v], half_edges.begin() + starts[v + 1],
                  [](const HalfEdge& x, const HalfEdge& y) {
                      return x.high != y.high ? x.high < y.high : x.face < y.face;
                  });
    }
    return half_edges;
}

}  // namespace coseg
