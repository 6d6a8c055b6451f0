#include "src/repair/border_welding.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "src/base/index.hpp"
#include "src/mesh/polygon_edges.hpp"

namespace coseg {

namespace {

constexpr double nearly_touching = 1e-3;

int root_of(std::vector<int>& parent, int v) {
    while (parent[at(v)] != v) v = parent[at(v)] = parent[at(parent[at(v)])];
    return v;
}

void unite(std::vector<int>& parent, int a, int b) {
    a = root_of(parent, a);
    b = root_of(parent, b);
    parent[at(std::max(a, b))] = std::min(a, b);
}

}  // namespace

BorderWelding weld_near_borders(const PolygonMesh& mesh, std::vector<int> vertex_of,
                                const BorderLimits& limits) {
    BorderWelding result{.vertex_of = std::move(vertex_of)};
    if (limits.of_size <= 0.0) return result;
    const std::vector<BorderEdge> edges = border_edges(mesh, result.vertex_of);
    if (edges.empty()) return result;
    const std::vector<int> before = result.vertex_of;
    for (const BorderMatch& match : match_borders(mesh, edges, limits)) {
        unite(result.vertex_of, edges[at(match.edge)].from, match.other_at_from);
        unite(result.vertex_of, edges[at(match.edge)].to, match.other_at_to);
    }
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        result.vertex_of[at(v)] = root_of(result.vertex_of, v);
        if (result.vertex_of[at(v)] != before[at(v)]) ++result.welded;
    }
    return result;
}

NearBorders near_borders(const PolygonMesh& mesh, const std::vector<int>& vertex_of) {
    NearBorders near;
    const std::vector<BorderEdge> edges = border_edges(mesh, vertex_of);
    if (edges.empty()) return near;
    const std::vector<BorderMatch> matches =
        match_borders(mesh, edges, border_welding_within(nearly_touching));
    if (matches.empty()) return near;
    const std::vector<int> piece_of_face = polygon_pieces(mesh, vertex_of);
    std::set<int> pieces;
    for (const BorderMatch& match : matches) {
        pieces.insert(piece_of_face[at(edges[at(match.edge)].face)]);
        pieces.insert(piece_of_face[at(edges[at(match.other)].face)]);
        near.distance = std::max(near.distance, match.distance);
    }
    near.pieces = static_cast<int>(pieces.size());
    near.distance /= used_diagonal(mesh);
    return near;
}

}  // namespace coseg
