#include "src/geodesics/surface_graph.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

#include "src/base/index.hpp"

namespace coseg {

namespace {

struct Connection {
    int from, to;
    float length;
};

class ConnectionList {
  public:
    explicit ConnectionList(std::size_t expected) { connections_.reserve(2 * expected); }
    void join(int a, int b, double length) {
        connections_.push_back({a, b, static_cast<float>(length)});
        connections_.push_back({b, a, static_cast<float>(length)});
    }
    [[nodiscard]] const std::vector<Connection>& all() const { return connections_; }

  private:
    std::vector<Connection> connections_;
};

int opposite_vertex(const TriMesh& mesh, int face, const DualEdge& edge) {
    for (int k = 0; k < 3; ++k) {
        const int v = mesh.faces(k, face);
        if (v != edge.vertex_a && v != edge.vertex_b) return v;
    }
    return -1;
}

/// Length of the line between the apexes over the edge a-b, if it crosses the edge once the faces lie in one
/// plane.
std::optional<double> unfolded_length(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                      const Eigen::Vector3d& apex, const Eigen::Vector3d& other_apex) {
    const Eigen::Vector3d along = b - a;
    const double length = along.norm();
    if (!(length > 0.0)) return std::nullopt;
    const Eigen::Vector3d axis = along / length;
    const double x = axis.dot(apex - a);
    const double other_x = axis.dot(other_apex - a);
    const double y = axis.cross(apex - a).norm();
    const double other_y = axis.cross(other_apex - a).norm();
    if (!(y > 0.0) || !(other_y > 0.0)) return std::nullopt;
    const double crossing = (x * other_y + other_x * y) / (y + other_y);
    if (crossing < 0.0 || crossing > length) return std::nullopt;
    return std::hypot(other_x - x, y + other_y);
}

void join_mesh_edges(const TriMesh& mesh, ConnectionList& list) {
    for (int f = 0; f < mesh.face_count(); ++f) {
        for (int k = 0; k < 3; ++k) {
            const int a = std::min(mesh.faces(k, f), mesh.faces((k + 1) % 3, f));
            const int b = std::max(mesh.faces(k, f), mesh.faces((k + 1) % 3, f));
            list.join(a, b, (mesh.vertices.col(b) - mesh.vertices.col(a)).norm());
        }
    }
}

void join_shortcuts(const TriMesh& mesh, const DualGraph& graph, ConnectionList& list) {
    for (const DualEdge& edge : graph.edges) {
        if (edge.is_virtual()) continue;
        const int apex = opposite_vertex(mesh, edge.face_a, edge);
        const int other_apex = opposite_vertex(mesh, edge.face_b, edge);
        if (apex < 0 || other_apex < 0 || apex == other_apex) continue;
        const std::optional<double> length =
            unfolded_length(mesh.vertices.col(edge.vertex_a), mesh.vertices.col(edge.vertex_b),
                            mesh.vertices.col(apex), mesh.vertices.col(other_apex));
        if (length) list.join(apex, other_apex, *length);
    }
}

/// Returns the number of nodes.
int join_virtual_edges(const TriMesh& mesh, const DualGraph& graph, ConnectionList& list) {
    std::map<int, int> node_of_face;
    int nodes = mesh.vertex_count();
    const auto centroid = [&](int face) -> Eigen::Vector3d {
        return (mesh.vertices.col(mesh.faces(0, face)) + mesh.vertices.col(mesh.faces(1, face)) +
                mesh.vertices.col(mesh.faces(2, face))) /
               3.0;
    };
    const auto node_of = [&](int face) {
        const auto [entry, is_new] = node_of_face.try_emplace(face, nodes);
        if (!is_new) return entry->second;
        ++nodes;
        for (int k = 0; k < 3; ++k) {
            const int v = mesh.faces(k, face);
            list.join(entry->second, v, (mesh.vertices.col(v) - centroid(face)).norm());
        }
        return entry->second;
    };
    for (const DualEdge& edge : graph.edges) {
        if (!edge.is_virtual()) continue;
        const int a = node_of(edge.face_a);
        const int b = node_of(edge.face_b);
        list.join(a, b, (centroid(edge.face_a) - centroid(edge.face_b)).norm());
    }
    return nodes;
}

/// Two faces give each interior edge twice, and two edges may give one pair of apexes two shortcuts: keep the
/// shortest.
void drop_repeated_arcs(SurfaceGraph& graph) {
    std::size_t kept = 0;
    for (int v = 0; v < graph.node_count(); ++v) {
        const auto begin = graph.arcs.begin() + graph.offsets[at(v)];
        const auto end = graph.arcs.begin() + graph.offsets[at(v) + 1];
        std::sort(begin, end, [](const SurfaceArc& x, const SurfaceArc& y) {
            return x.node != y.node ? x.node < y.node : x.length < y.length;
        });
        const std::size_t first = kept;
        for (auto arc = begin; arc != end; ++arc) {
            if (kept == first || graph.arcs[kept - 1].node != arc->node) graph.arcs[kept++] = *arc;
        }
        graph.offsets[at(v)] = static_cast<int>(first);
    }
    graph.offsets.back() = static_cast<int>(kept);
    graph.arcs.resize(kept);
    graph.arcs.shrink_to_fit();
}

SurfaceGraph grouped_by_node(const ConnectionList& list, int vertices, int nodes) {
    SurfaceGraph graph;
    graph.vertex_count = vertices;
    graph.offsets.assign(at(nodes) + 1, 0);
    for (const Connection& c : list.all()) ++graph.offsets[at(c.from) + 1];
    std::partial_sum(graph.offsets.begin(), graph.offsets.end(), graph.offsets.begin());
    graph.arcs.resize(list.all().size());
    std::vector<int> next(graph.offsets.begin(), graph.offsets.end() - 1);
    for (const Connection& c : list.all()) {
        graph.arcs[at(next[at(c.from)]++)] = {c.to, c.length};
    }
    return graph;
}

}  // namespace

SurfaceGraph surface_graph(const TriMesh& mesh, const DualGraph& graph) {
    ConnectionList list(at(mesh.face_count()) * 3 + graph.edges.size());
    join_mesh_edges(mesh, list);
    join_shortcuts(mesh, graph, list);
    const int nodes = join_virtual_edges(mesh, graph, list);
    SurfaceGraph result = grouped_by_node(list, mesh.vertex_count(), nodes);
    drop_repeated_arcs(result);
    return result;
}

}  // namespace coseg
