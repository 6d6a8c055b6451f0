#include "src/remesh/strip_subdivision.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "src/base/index.hpp"
#include "src/mesh/edge_groups.hpp"

namespace coseg {

namespace {

using Eigen::Vector3d;

/// The edges of a mesh, and how many pieces each is cut into.
struct CutEdges {
    std::vector<int> of_half_edge;  ///< half-edge 3 f + k runs from corner k of face f to the next
    std::vector<double> pieces;
    std::vector<int> first_point;  ///< new points lie from the lower vertex to the higher
};

double pieces_of(const TriMesh& mesh, int a, int b, double longest_edge) {
    return std::max(1.0, std::ceil((mesh.vertices.col(a) - mesh.vertices.col(b)).norm() / longest_edge));
}

CutEdges cut_edges(const TriMesh& mesh, double longest_edge) {
    std::vector<int> from;
    std::vector<int> to;
    for (int f = 0; f < mesh.face_count(); ++f) {
        for (int k = 0; k < 3; ++k) {
            from.push_back(mesh.faces(k, f));
            to.push_back(mesh.faces((k + 1) % 3, f));
        }
    }
    const EdgeGroups groups = group_edges(from, to, mesh.vertex_count());
    CutEdges edges;
    edges.of_half_edge.resize(from.size());
    for (int g = 0; g < groups.count(); ++g) {
        const auto first = at(groups.half_edges[at(groups.offsets[at(g)])]);
        edges.pieces.push_back(pieces_of(mesh, from[first], to[first], longest_edge));
        for (int i = groups.offsets[at(g)]; i < groups.offsets[at(g) + 1]; ++i)
            edges.of_half_edge[at(groups.half_edges[at(i)])] = g;
    }
    return edges;
}

/// In floating point: there may be more than integers hold.
double faces_after(const CutEdges& edges) {
    double faces = 0.0;
    for (std::size_t h = 0; h < edges.of_half_edge.size(); ++h)
        faces += edges.pieces[at(edges.of_half_edge[h])] - 2.0 / 3.0;
    return faces;
}

/// Appends the points of the half-edge after its start, without its end.
void add_inner_points(const TriMesh& mesh, const CutEdges& edges, int half_edge, std::vector<int>& chain) {
    const int edge = edges.of_half_edge[at(half_edge)];
    const int inner = static_cast<int>(edges.pieces[at(edge)]) - 1;
    const int face = half_edge / 3;
    const bool ascends = mesh.faces(half_edge % 3, face) < mesh.faces((half_edge + 1) % 3, face);
    for (int i = 0; i < inner; ++i)
        chain.push_back(edges.first_point[at(edge)] + (ascends ? i : inner - 1 - i));
}

std::vector<Vector3d> place_points(const TriMesh& mesh, CutEdges& edges) {
    std::vector<Vector3d> points;
    for (int v = 0; v < mesh.vertex_count(); ++v) points.emplace_back(mesh.vertices.col(v));
    edges.first_point.assign(edges.pieces.size(), -1);
    for (int h = 0; h < 3 * mesh.face_count(); ++h) {
        const auto edge = at(edges.of_half_edge[at(h)]);
        if (edges.first_point[edge] >= 0) continue;
        edges.first_point[edge] = static_cast<int>(points.size());
        const int x = mesh.faces(h % 3, h / 3);
        const int y = mesh.faces((h + 1) % 3, h / 3);
        const Vector3d low = mesh.vertices.col(std::min(x, y));
        const Vector3d high = mesh.vertices.col(std::max(x, y));
        for (double i = 1.0; i < edges.pieces[edge]; i += 1.0)
            points.emplace_back(low + i / edges.pieces[edge] * (high - low));
    }
    return points;
}

int longest_side(const TriMesh& mesh, int face) {
    std::array<double, 3> length{};
    for (int k = 0; k < 3; ++k) {
        length[at(k)] =
            (mesh.vertices.col(mesh.faces(k, face)) - mesh.vertices.col(mesh.faces((k + 1) % 3, face)))
                .squaredNorm();
    }
    return static_cast<int>(std::max_element(length.begin(), length.end()) - length.begin());
}

/// Triangles between two chains of points that share both ends; `base` is straight, and `other` lies on its
/// left.
void fill_between(const std::vector<int>& base, const std::vector<int>& other,
                  const std::vector<Vector3d>& points, std::vector<Eigen::Vector3i>& triangles) {
    if (base.size() == 2) {
        triangles.emplace_back(base[0], base[1], other[1]);
        return;
    }
    const Vector3d along = points[at(base.back())] - points[at(base.front())];
    const auto place = [&](int point) { return along.dot(points[at(point)] - points[at(base.front())]); };
    triangles.emplace_back(base[0], base[1], other[1]);
    std::size_t i = 1;
    std::size_t j = 1;
    while (i + 2 < base.size() || j + 2 < other.size()) {
        const bool base_is_next =
            j + 2 == other.size() || (i + 2 < base.size() && place(base[i + 1]) <= place(other[j + 1]));
        if (base_is_next) {
            triangles.emplace_back(base[i], base[i + 1], other[j]);
            ++i;
        } else {
            triangles.emplace_back(base[i], other[j + 1], other[j]);
            ++j;
        }
    }
    triangles.emplace_back(base[i], base[i + 1], other[j]);
}

std::vector<Eigen::Vector3i> strips(const TriMesh& mesh, const CutEdges& edges,
                                    const std::vector<Vector3d>& points) {
    std::vector<Eigen::Vector3i> triangles;
    std::vector<int> base;
    std::vector<int> other;
    std::vector<int> back;
    for (int f = 0; f < mesh.face_count(); ++f) {
        const int k = longest_side(mesh, f);
        base.assign(1, mesh.faces(k, f));
        add_inner_points(mesh, edges, 3 * f + k, base);
        base.push_back(mesh.faces((k + 1) % 3, f));
        back.assign(1, base.back());
        add_inner_points(mesh, edges, 3 * f + (k + 1) % 3, back);
        back.push_back(mesh.faces((k + 2) % 3, f));
        add_inner_points(mesh, edges, 3 * f + (k + 2) % 3, back);
        back.push_back(base.front());
        other.assign(back.rbegin(), back.rend());
        fill_between(base, other, points, triangles);
    }
    return triangles;
}

}  // namespace

std::optional<TriMesh> cut_into_strips(const TriMesh& mesh, double longest_edge, int most_faces) {
    CutEdges edges = cut_edges(mesh, longest_edge);
    if (!(faces_after(edges) <= most_faces + 0.5)) return std::nullopt;
    const std::vector<Vector3d> points = place_points(mesh, edges);
    const std::vector<Eigen::Vector3i> triangles = strips(mesh, edges, points);
    TriMesh cut;
    cut.vertices.resize(3, static_cast<Eigen::Index>(points.size()));
    for (std::size_t v = 0; v < points.size(); ++v)
        cut.vertices.col(static_cast<Eigen::Index>(v)) = points[v];
    cut.faces.resize(3, static_cast<Eigen::Index>(triangles.size()));
    for (std::size_t f = 0; f < triangles.size(); ++f)
        cut.faces.col(static_cast<Eigen::Index>(f)) = triangles[f];
    return cut;
}

}  // namespace coseg
