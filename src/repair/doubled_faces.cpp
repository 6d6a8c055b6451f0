#include "src/repair/doubled_faces.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <utility>

#include "src/base/index.hpp"
#include "src/base/seeded_random.hpp"
#include "src/mesh/polygon_edges.hpp"

namespace coseg {

namespace {

using Point = std::array<double, 3>;

/// Share of a piece's faces with doubles from which on the piece lies upon itself or another one.
constexpr double wholly = 0.9;

Point point_of(const PolygonMesh& mesh, int vertex) {
    const Eigen::Vector3d& p = mesh.vertices[at(vertex)];
    return {p.x() + 0.0, p.y() + 0.0, p.z() + 0.0};  // -0 becomes 0
}

std::vector<Point> sorted_points(const PolygonMesh& mesh, int face) {
    std::vector<Point> points;
    for (int k = mesh.offsets[at(face)]; k < mesh.offsets[at(face) + 1]; ++k)
        points.push_back(point_of(mesh, mesh.corners[at(k)]));
    std::sort(points.begin(), points.end());
    return points;
}

/// The same for faces with the same corners in any order.
std::vector<std::uint64_t> face_hashes(const PolygonMesh& mesh) {
    std::vector<std::uint64_t> of_vertex(mesh.vertices.size());
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        const Point p = point_of(mesh, v);
        of_vertex[at(v)] = hash_words({std::bit_cast<std::uint64_t>(p[0]), std::bit_cast<std::uint64_t>(p[1]),
                                       std::bit_cast<std::uint64_t>(p[2])});
    }
    std::vector<std::uint64_t> of_face(at(mesh.face_count()), 0);
    for (int f = 0; f < mesh.face_count(); ++f) {
        for (int k = mesh.offsets[at(f)]; k < mesh.offsets[at(f) + 1]; ++k)
            of_face[at(f)] += of_vertex[at(mesh.corners[at(k)])];
    }
    return of_face;
}

/// Faces that lie upon each other, ascending in each group; groups of one are left out.
std::vector<std::vector<int>> groups_of_doubles(const PolygonMesh& mesh) {
    const std::vector<std::uint64_t> hash = face_hashes(mesh);
    std::vector<int> order(hash.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(),
              [&](int a, int b) { return std::pair(hash[at(a)], a) < std::pair(hash[at(b)], b); });
    std::vector<std::vector<int>> groups;
    for (auto run = order.begin(); run != order.end();) {
        const auto end = std::find_if(run, order.end(), [&](int f) { return hash[at(f)] != hash[at(*run)]; });
        if (end - run > 1) {
            std::map<std::vector<Point>, std::vector<int>> same;
            for (auto f = run; f != end; ++f) same[sorted_points(mesh, *f)].push_back(*f);
            for (auto& [points, faces] : same) {
                if (faces.size() > 1 && points.size() > 2) groups.push_back(std::move(faces));
            }
        }
        run = end;
    }
    return groups;
}

std::vector<int> sorted_corners(const PolygonMesh& mesh, const std::vector<int>& vertex_of, int face) {
    std::vector<int> corners;
    for (int k = mesh.offsets[at(face)]; k < mesh.offsets[at(face) + 1]; ++k)
        corners.push_back(vertex_of[at(mesh.corners[at(k)])]);
    std::sort(corners.begin(), corners.end());
    return corners;
}

/// Per face whether its piece lies wholly upon itself or another one.
std::vector<char> in_doubled_pieces(const PolygonMesh& mesh, const std::vector<int>& vertex_of,
                                    const std::vector<std::vector<int>>& groups) {
    const std::vector<int> piece = polygon_pieces(mesh, vertex_of);
    std::vector<int> faces(piece.size(), 0);
    std::vector<int> with_double(piece.size(), 0);
    for (const int p : piece) ++faces[at(p)];
    for (const std::vector<int>& group : groups) {
        for (const int f : group) ++with_double[at(piece[at(f)])];
    }
    std::vector<char> doubled(piece.size());
    for (std::size_t f = 0; f < piece.size(); ++f)
        doubled[f] = with_double[at(piece[f])] >= wholly * faces[at(piece[f])] ? 1 : 0;
    return doubled;
}

void leave_out(DoubledFaces& result, const std::vector<int>& group, const std::vector<char>& doubled) {
    const auto stays = std::find_if(group.begin(), group.end(), [&](int f) { return doubled[at(f)] == 0; });
    const int kept = stays != group.end() ? *stays : group.front();
    for (const int f : group) {
        if (doubled[at(f)] == 0 || f == kept) continue;
        result.left_out[at(f)] = 1;
        result.label_of[at(f)] = kept;
    }
}

/// Doubles that stay.
void share_labels(DoubledFaces& result, const PolygonMesh& mesh, const std::vector<int>& group) {
    std::map<std::vector<int>, int> first;
    for (const int f : group) {
        if (result.left_out[at(f)] == 0)
            result.label_of[at(f)] =
                first.try_emplace(sorted_corners(mesh, result.vertex_of, f), f).first->second;
    }
}

/// Joins vertices at the same place whose faces all belong to pieces that are left out in part.
void join_vertices(DoubledFaces& result, const PolygonMesh& mesh, const std::vector<char>& doubled) {
    std::map<Point, int> lowest;
    std::vector<int> vertices;
    for (int f = 0; f < mesh.face_count(); ++f) {
        if (doubled[at(f)] == 0) continue;
        for (int k = mesh.offsets[at(f)]; k < mesh.offsets[at(f) + 1]; ++k)
            vertices.push_back(result.vertex_of[at(mesh.corners[at(k)])]);
    }
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    std::vector<int> stand_in(mesh.vertices.size());
    std::iota(stand_in.begin(), stand_in.end(), 0);
    for (const int v : vertices) stand_in[at(v)] = lowest.try_emplace(point_of(mesh, v), v).first->second;
    for (int& v : result.vertex_of) v = stand_in[at(v)];
}

}  // namespace

DoubledFaces find_doubled_faces(const PolygonMesh& mesh, std::vector<int> vertex_of) {
    DoubledFaces result{.vertex_of = std::move(vertex_of),
                        .label_of = std::vector<int>(at(mesh.face_count())),
                        .left_out = std::vector<char>(at(mesh.face_count()), 0)};
    std::iota(result.label_of.begin(), result.label_of.end(), 0);
    const std::vector<std::vector<int>> groups = groups_of_doubles(mesh);
    if (groups.empty()) return result;
    const std::vector<char> doubled = in_doubled_pieces(mesh, result.vertex_of, groups);
    if (std::find(doubled.begin(), doubled.end(), 1) != doubled.end()) join_vertices(result, mesh, doubled);
    for (const std::vector<int>& group : groups) {
        leave_out(result, group, doubled);
        share_labels(result, mesh, group);
    }
    for (int f = 0; f < mesh.face_count(); ++f) {
        result.label_of[at(f)] = result.label_of[at(result.label_of[at(f)])];
        result.count += result.label_of[at(f)] != f ? 1 : 0;
    }
    return result;
}

}  // namespace coseg
