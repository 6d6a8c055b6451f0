#include "src/mesh/vertex_welding.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>

#include "src/base/index.hpp"
#include "src/mesh/edge_groups.hpp"

namespace coseg {

namespace {

struct HalfEdges {
    std::vector<int> from;
    std::vector<int> to;
};

HalfEdges half_edges_of(const PolygonMesh& mesh) {
    HalfEdges edges{mesh.corners, std::vector<int>(mesh.corners.size())};
    for (int f = 0; f < mesh.face_count(); ++f) {
        const int begin = mesh.offsets[at(f)];
        const int end = mesh.offsets[at(f) + 1];
        for (int k = begin; k < end; ++k) edges.to[at(k)] = mesh.corners[at(k + 1 < end ? k + 1 : begin)];
    }
    return edges;
}

std::vector<int> weldable_vertices(const PolygonMesh& mesh) {
    const HalfEdges edges = half_edges_of(mesh);
    const EdgeGroups groups = group_edges(edges.from, edges.to, mesh.vertex_count());
    std::vector<char> weldable(mesh.vertices.size(), 0);
    for (int g = 0; g < groups.count(); ++g) {
        const auto h = at(groups.half_edges[at(groups.offsets[at(g)])]);
        const bool has_one_face = groups.offsets[at(g) + 1] - groups.offsets[at(g)] == 1;
        const bool has_no_length = mesh.vertices[at(edges.from[h])] == mesh.vertices[at(edges.to[h])];
        if (has_one_face || has_no_length) weldable[at(edges.from[h])] = weldable[at(edges.to[h])] = 1;
    }
    std::vector<int> list;
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        if (weldable[at(v)] != 0) list.push_back(v);
    }
    return list;
}

}  // namespace

std::vector<int> weld_vertices(const PolygonMesh& mesh) {
    std::vector<int> representative(mesh.vertices.size());
    std::iota(representative.begin(), representative.end(), 0);
    std::vector<int> list = weldable_vertices(mesh);
    const auto key = [&](int v) {
        const Eigen::Vector3d& p = mesh.vertices[at(v)];
        return std::array<double, 3>{p.x(), p.y(), p.z()};
    };
    std::stable_sort(list.begin(), list.end(), [&](int a, int b) { return key(a) < key(b); });
    for (std::size_t i = 1; i < list.size(); ++i) {
        if (key(list[i]) == key(list[i - 1])) representative[at(list[i])] = representative[at(list[i - 1])];
    }
    return representative;
}

}  // namespace coseg
