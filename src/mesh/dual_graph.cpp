#include "src/mesh/dual_graph.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "src/base/index.hpp"
#include "src/mesh/connected_pieces.hpp"
#include "src/mesh/half_edges.hpp"
#include "src/mesh/spanning_joins.hpp"

namespace coseg {

namespace {

/// Angle outside the solid between two faces that share the edge a -> b of `first`: pi + the signed exterior
/// turn.
double outer_dihedral(const Eigen::Vector3d& n_first, const Eigen::Vector3d& n_second,
                      const Eigen::Vector3d& edge) {
    const double sine = n_first.cross(n_second).dot(edge.normalized());
    const double cosine = n_first.dot(n_second);
    return std::numbers::pi + std::atan2(sine, cosine);
}

DualEdge make_edge(const TriMesh& mesh, const Eigen::Matrix3Xd& normals, const HalfEdge& x,
                   const HalfEdge& y) {
    DualEdge edge{.face_a = x.face, .face_b = y.face, .vertex_a = x.low, .vertex_b = x.high};
    Eigen::Vector3d along = mesh.vertices.col(x.high) - mesh.vertices.col(x.low);
    edge.length = along.norm();
    if (!x.forward) along = -along;
    edge.dihedral = outer_dihedral(normals.col(x.face), normals.col(y.face), along);
    return edge;
}

void sort_edges(std::vector<DualEdge>& edges) {
    std::sort(edges.begin(), edges.end(), [](const DualEdge& x, const DualEdge& y) {
        return std::array{x.face_a, x.face_b, x.vertex_a, x.vertex_b} <
               std::array{y.face_a, y.face_b, y.vertex_a, y.vertex_b};
    });
}

std::vector<DualEdge> mesh_edges(const TriMesh& mesh) {
    const std::vector<HalfEdge> half_edges = sorted_half_edges(mesh);
    const Eigen::Matrix3Xd normals = face_normals(mesh);
    std::vector<DualEdge> edges;
    edges.reserve(half_edges.size() / 2);
    for (std::size_t i = 0; i + 1 < half_edges.size(); ++i) {
        if (share_edge(half_edges[i], half_edges[i + 1])) {
            edges.push_back(make_edge(mesh, normals, half_edges[i], half_edges[i + 1]));
        }
    }
    sort_edges(edges);
    return edges;
}

/// A tenth of the side of a mean face. Components are thus cut apart at the lowest cost that a cut can have,
/// but two of them still count as neighbours.
double virtual_length(const FaceGeometry& geometry) {
    return 0.1 * std::sqrt(geometry.total_area /
                           static_cast<double>(std::max<Eigen::Index>(1, geometry.area.size())));
}

void join_components(DualGraph& graph, const FaceGeometry& geometry) {
    const std::vector<int> component = face_components(graph);
    const int count = component.empty() ? 0 : 1 + *std::max_element(component.begin(), component.end());
    if (count <= 1) return;
    const double length = virtual_length(geometry);
    graph.edges.reserve(graph.edges.size() + at(count - 1));
    for (const PointJoin& join : spanning_joins(geometry.centroid, component, count)) {
        graph.edges.push_back(
            {.face_a = join.point_a, .face_b = join.point_b, .length = length, .dihedral = std::numbers::pi});
    }
    sort_edges(graph.edges);
    index_incidence(graph);
}

}  // namespace

void index_incidence(DualGraph& graph) {
    graph.offsets.assign(at(graph.face_count) + 1, 0);
    for (const DualEdge& e : graph.edges) {
        ++graph.offsets[at(e.face_a) + 1];
        ++graph.offsets[at(e.face_b) + 1];
    }
    std::partial_sum(graph.offsets.begin(), graph.offsets.end(), graph.offsets.begin());
    graph.incident.resize(graph.edges.size() * 2);
    std::vector<int> next(graph.offsets.begin(), graph.offsets.end() - 1);
    for (std::size_t e = 0; e < graph.edges.size(); ++e) {
        for (const int f : {graph.edges[e].face_a, graph.edges[e].face_b}) {
            graph.incident[at(next[at(f)]++)] = static_cast<int>(e);
        }
    }
}

DualGraph dual_graph(const TriMesh& mesh, const FaceGeometry& geometry) {
    DualGraph graph;
    graph.face_count = mesh.face_count();
    graph.edges = mesh_edges(mesh);
    index_incidence(graph);
    join_components(graph, geometry);
    return graph;
}

void release_incidence(DualGraph& graph) {
    graph.offsets = {};
    graph.incident = {};
}

std::vector<int> face_components(const DualGraph& graph) {
    const std::vector<int> one_label(at(graph.face_count), 0);
    return connected_pieces(graph, one_label, VirtualEdges::ignored);
}

}  // namespace coseg
