#include "src/mesh/polygon_edges.hpp"

#include <algorithm>
#include <numeric>

#include "src/base/index.hpp"
#include "src/mesh/edge_groups.hpp"

namespace coseg {

PolygonHalfEdges polygon_half_edges(const PolygonMesh& mesh, const std::vector<int>& vertex_of) {
    PolygonHalfEdges edges;
    edges.from.reserve(mesh.corners.size());
    edges.to.reserve(mesh.corners.size());
    edges.face.reserve(mesh.corners.size());
    for (int f = 0; f < mesh.face_count(); ++f) {
        const int begin = mesh.offsets[at(f)];
        const int end = mesh.offsets[at(f) + 1];
        for (int k = begin; k < end; ++k) {
            edges.from.push_back(vertex_of[at(mesh.corners[at(k)])]);
            edges.to.push_back(vertex_of[at(mesh.corners[at(k + 1 < end ? k + 1 : begin)])]);
            edges.face.push_back(f);
        }
    }
    return edges;
}

std::vector<int> polygon_pieces(const PolygonMesh& mesh, const std::vector<int>& vertex_of) {
    const PolygonHalfEdges edges = polygon_half_edges(mesh, vertex_of);
    const EdgeGroups groups = group_edges(edges.from, edges.to, mesh.vertex_count());
    std::vector<int> piece(at(mesh.face_count()));
    std::iota(piece.begin(), piece.end(), 0);
    const auto root = [&](int f) {
        while (piece[at(f)] != f) f = piece[at(f)] = piece[at(piece[at(f)])];
        return f;
    };
    for (int g = 0; g < groups.count(); ++g) {
        const int begin = groups.offsets[at(g)];
        const int first = edges.face[at(groups.half_edges[at(begin)])];
        for (int k = begin + 1; k < groups.offsets[at(g) + 1]; ++k) {
            const int a = root(first);
            const int b = root(edges.face[at(groups.half_edges[at(k)])]);
            piece[at(std::max(a, b))] = std::min(a, b);
        }
    }
    for (int f = 0; f < mesh.face_count(); ++f) piece[at(f)] = root(f);
    return piece;
}

}  // namespace coseg
