#include "src/measures/part_measures.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "src/base/index.hpp"
#include "src/measures/part_pieces.hpp"
#include "src/mesh/half_edges.hpp"

namespace coseg {

namespace {

/// Half of the cross product of two sides: the normal, as long as the area.
Eigen::Vector3d area_vector(const TriMesh& mesh, int face) {
    const Eigen::Vector3d a = mesh.vertices.col(mesh.faces(0, face));
    const Eigen::Vector3d b = mesh.vertices.col(mesh.faces(1, face));
    const Eigen::Vector3d c = mesh.vertices.col(mesh.faces(2, face));
    return 0.5 * (b - a).cross(c - a);
}

/// Six times the volume of a tetrahedron.
double triple(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
    return a.dot(b.cross(c));
}

/// A side of an edge whose other side lies in another piece.
struct RimEdge {
    int from;
    int to;
};

/// The rims of all pieces, and which pieces end in the open.
struct Rims {
    std::vector<std::vector<RimEdge>> edges;  ///< by piece
    std::vector<char> is_open;                ///< by piece
};

RimEdge rim_edge(const HalfEdge& side) {
    return side.forward ? RimEdge{side.low, side.high} : RimEdge{side.high, side.low};
}

Rims rims_of(const TriMesh& mesh, const std::vector<int>& piece, int pieces) {
    Rims rims{std::vector<std::vector<RimEdge>>(at(pieces)), std::vector<char>(at(pieces), 0)};
    const std::vector<HalfEdge> sides = sorted_half_edges(mesh);
    for (std::size_t k = 0; k < sides.size(); ++k) {
        const bool has_other = k + 1 < sides.size() && share_edge(sides[k], sides[k + 1]);
        if (!has_other) {
            rims.is_open[at(piece[at(sides[k].face)])] = 1;
            continue;
        }
        const int a = piece[at(sides[k].face)];
        const int b = piece[at(sides[k + 1].face)];
        if (a != b) {
            rims.edges[at(a)].push_back(rim_edge(sides[k]));
            rims.edges[at(b)].push_back(rim_edge(sides[k + 1]));
        }
        ++k;
    }
    return rims;
}

/// The edges of a rim that hang together, one list each.
std::vector<std::vector<RimEdge>> connected_rims(const std::vector<RimEdge>& edges) {
    std::map<int, int> joined;  // vertex -> a vertex that it hangs together with
    const auto root_of = [&](int vertex) {
        joined.try_emplace(vertex, vertex);
        while (joined[vertex] != vertex) vertex = joined[vertex] = joined[joined[vertex]];
        return vertex;
    };
    for (const RimEdge& edge : edges) {
        const int a = root_of(edge.from);
        const int b = root_of(edge.to);
        joined[std::max(a, b)] = std::min(a, b);
    }
    std::map<int, std::vector<RimEdge>> rims;
    for (const RimEdge& edge : edges) rims[root_of(edge.from)].push_back(edge);
    std::vector<std::vector<RimEdge>> lists;
    for (auto& [root, list] : rims) lists.push_back(std::move(list));
    return lists;
}

/// Six times the volume between the lid of a rim and `origin`, with the direction in which the piece sees it.
double lid(const TriMesh& mesh, const std::vector<RimEdge>& rim, const Eigen::Vector3d& origin) {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    double length = 0.0;
    for (const RimEdge& edge : rim) {
        const Eigen::Vector3d a = mesh.vertices.col(edge.from) - origin;
        const Eigen::Vector3d b = mesh.vertices.col(edge.to) - origin;
        const double weight = (b - a).norm();
        middle += 0.5 * weight * (a + b);
        length += weight;
    }
    if (length > 0.0) middle /= length;
    double sum = 0.0;
    for (const RimEdge& edge : rim) {
        const Eigen::Vector3d a = mesh.vertices.col(edge.from) - origin;
        const Eigen::Vector3d b = mesh.vertices.col(edge.to) - origin;
        sum += triple(b, a, middle);
    }
    return sum;
}

/// The volumes of all pieces with their lids; of an open piece it means nothing.
std::vector<double> volumes_of(const TriMesh& mesh, const std::vector<int>& piece, const Rims& rims) {
    std::vector<double> six_volumes(rims.edges.size(), 0.0);
    std::vector<int> first_vertex(rims.edges.size(), -1);
    const auto origin_of = [&](std::size_t k) { return Eigen::Vector3d(mesh.vertices.col(first_vertex[k])); };
    for (int f = 0; f < mesh.face_count(); ++f) {
        const std::size_t k = at(piece[at(f)]);
        if (first_vertex[k] < 0) first_vertex[k] = mesh.faces(0, f);
        const Eigen::Vector3d origin = origin_of(k);
        six_volumes[k] +=
            triple(mesh.vertices.col(mesh.faces(0, f)) - origin, mesh.vertices.col(mesh.faces(1, f)) - origin,
                   mesh.vertices.col(mesh.faces(2, f)) - origin);
    }
    for (std::size_t k = 0; k < six_volumes.size(); ++k) {
        for (const std::vector<RimEdge>& rim : connected_rims(rims.edges[k]))
            six_volumes[k] += lid(mesh, rim, origin_of(k));
        six_volumes[k] = std::abs(six_volumes[k]) / 6.0;
    }
    return six_volumes;
}

/// The normals of the faces, those of (nearly) one direction taken together, the largest area first.
std::vector<Eigen::Vector3d> largest_planes(const std::vector<Eigen::Vector3d>& area_vectors) {
    constexpr std::size_t most = 32;
    constexpr double steps = 64.0;  // of a component: directions within about a degree are one
    std::map<std::array<int, 3>, Eigen::Vector3d> sums;
    for (const Eigen::Vector3d& area : area_vectors) {
        if (!(area.norm() > 0.0)) continue;
        const Eigen::Vector3d normal = area.normalized();
        const auto step = [&](int k) { return static_cast<int>(std::lround(steps * normal[k])); };
        sums.try_emplace({step(0), step(1), step(2)}, Eigen::Vector3d::Zero()).first->second += area;
    }
    std::vector<Eigen::Vector3d> planes;
    for (const auto& [direction, sum] : sums) planes.push_back(sum);
    std::stable_sort(planes.begin(), planes.end(), [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
        return a.squaredNorm() > b.squaredNorm();
    });
    if (planes.size() > most) planes.resize(most);
    return planes;
}

OrientedBox box_of(const TriMesh& mesh, const std::vector<int>& faces) {
    std::set<int> vertices;
    std::vector<Eigen::Vector3d> area_vectors;
    for (const int f : faces) {
        for (int k = 0; k < 3; ++k) vertices.insert(mesh.faces(k, f));
        area_vectors.push_back(area_vector(mesh, f));
    }
    std::vector<Eigen::Vector3d> points;
    for (const int v : vertices) points.emplace_back(mesh.vertices.col(v));
    return oriented_box(points, largest_planes(area_vectors));
}

PartMeasures surface_measures(const TriMesh& mesh, const std::vector<int>& faces) {
    PartMeasures measures;
    for (const int f : faces) {
        const double area = area_vector(mesh, f).norm();
        measures.area += area;
        for (int k = 0; k < 3; ++k) measures.centroid += area / 3.0 * mesh.vertices.col(mesh.faces(k, f));
    }
    if (measures.area > 0.0)
        measures.centroid /= measures.area;
    else
        measures.centroid = mesh.vertices.col(mesh.faces(0, faces.front()));
    measures.box = box_of(mesh, faces);
    return measures;
}

std::map<int, double> border_lengths(const std::vector<BorderCurve>& curves, int part) {
    std::map<int, double> lengths;
    for (const BorderCurve& curve : curves) {
        if (curve.part_a == part) lengths[curve.part_b] += curve.length;
        if (curve.part_b == part) lengths[curve.part_a] += curve.length;
    }
    return lengths;
}

}  // namespace

std::vector<PartMeasures> part_measures(const TriMesh& mesh, const std::vector<int>& part_of_face,
                                        const std::vector<BorderCurve>& curves) {
    const std::vector<int> piece = part_pieces(mesh, part_of_face);
    const int pieces = piece.empty() ? 0 : *std::max_element(piece.begin(), piece.end()) + 1;
    const Rims rims = rims_of(mesh, piece, pieces);
    const std::vector<double> volumes = volumes_of(mesh, piece, rims);
    std::map<int, std::vector<int>> faces_of_part;
    for (int f = 0; f < mesh.face_count(); ++f) faces_of_part[part_of_face[at(f)]].push_back(f);
    std::vector<PartMeasures> all;
    double total = 0.0;
    for (const auto& [part, faces] : faces_of_part) {
        PartMeasures measures = surface_measures(mesh, faces);
        measures.part = part;
        std::set<int> of_part;
        for (const int f : faces) of_part.insert(piece[at(f)]);
        measures.pieces = static_cast<int>(of_part.size());
        const bool is_open =
            std::any_of(of_part.begin(), of_part.end(), [&](int k) { return rims.is_open[at(k)] != 0; });
        double volume = 0.0;
        for (const int k : of_part) volume += volumes[at(k)];
        if (!is_open) measures.volume = volume;
        const std::map<int, double> lengths = border_lengths(curves, part);
        measures.borders.assign(lengths.begin(), lengths.end());
        total += measures.area;
        all.push_back(std::move(measures));
    }
    for (PartMeasures& measures : all) measures.share = total > 0.0 ? measures.area / total : 0.0;
    return all;
}

}  // namespace coseg
