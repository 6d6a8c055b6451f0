#pragma once
// Independent checks of what src/repair/mesh_repair.hpp promises, and ways between the two kinds of mesh.

#include <Eigen/LU>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "src/mesh/polygon_mesh.hpp"
#include "src/mesh/tri_mesh.hpp"

namespace coseg::test {

inline PolygonMesh as_polygons(const TriMesh& mesh) {
    PolygonMesh polygons;
    for (int v = 0; v < mesh.vertex_count(); ++v) polygons.vertices.emplace_back(mesh.vertices.col(v));
    polygons.offsets.push_back(0);
    for (int f = 0; f < mesh.face_count(); ++f) {
        for (int k = 0; k < 3; ++k) polygons.corners.push_back(mesh.faces(k, f));
        polygons.offsets.push_back(static_cast<int>(polygons.corners.size()));
    }
    return polygons;
}

inline PolygonMesh polygons_of(const std::vector<Eigen::Vector3d>& vertices,
                               const std::vector<std::vector<int>>& faces) {
    PolygonMesh mesh;
    mesh.vertices = vertices;
    mesh.offsets.push_back(0);
    for (const auto& face : faces) {
        mesh.corners.insert(mesh.corners.end(), face.begin(), face.end());
        mesh.offsets.push_back(static_cast<int>(mesh.corners.size()));
    }
    return mesh;
}

/// Every vertex standing for itself.
inline std::vector<int> each_its_own(const PolygonMesh& mesh) {
    std::vector<int> vertex_of(mesh.vertices.size());
    std::iota(vertex_of.begin(), vertex_of.end(), 0);
    return vertex_of;
}

/// Every face with vertices of its own.
inline PolygonMesh soup_of(const PolygonMesh& mesh) {
    PolygonMesh soup;
    soup.offsets = mesh.offsets;
    for (const int corner : mesh.corners) {
        soup.corners.push_back(soup.vertex_count());
        soup.vertices.push_back(mesh.vertices[static_cast<std::size_t>(corner)]);
    }
    return soup;
}

/// Empty if every edge has at most two faces in opposite directions, every vertex a face, and its faces form
/// one fan; else what is wrong.
inline std::string manifold_defect(const TriMesh& mesh) {
    std::set<std::pair<int, int>> directed;
    std::vector<std::vector<int>> around(static_cast<std::size_t>(mesh.vertex_count()));
    for (int f = 0; f < mesh.face_count(); ++f) {
        for (int k = 0; k < 3; ++k) {
            const int a = mesh.faces(k, f);
            const int b = mesh.faces((k + 1) % 3, f);
            if (a == b) return "face " + std::to_string(f) + " repeats a vertex";
            if (!directed.insert({a, b}).second)
                return "edge " + std::to_string(a) + " " + std::to_string(b) + " runs twice one way";
            around[static_cast<std::size_t>(a)].push_back(f);
        }
    }
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        const auto& faces = around[static_cast<std::size_t>(v)];
        if (faces.empty()) return "vertex " + std::to_string(v) + " has no face";
        std::map<int, int> next;  // link: from the corner after v to the corner before v
        std::set<int> targets;
        for (const int f : faces) {
            for (int k = 0; k < 3; ++k) {
                if (mesh.faces(k, f) != v) continue;
                next[mesh.faces((k + 1) % 3, f)] = mesh.faces((k + 2) % 3, f);
                targets.insert(mesh.faces((k + 2) % 3, f));
            }
        }
        int start = next.begin()->first;
        for (const auto& [from, to] : next) {
            if (targets.count(from) == 0) start = from;
        }
        std::size_t steps = 0;
        for (int at = start; next.count(at) != 0 && steps < faces.size(); ++steps) at = next[at];
        if (steps != faces.size()) return "vertex " + std::to_string(v) + " has more than one fan";
    }
    return "";
}

/// Edges with one face only.
inline int boundary_edges(const TriMesh& mesh) {
    std::set<std::pair<int, int>> directed;
    for (int f = 0; f < mesh.face_count(); ++f) {
        for (int k = 0; k < 3; ++k) directed.insert({mesh.faces(k, f), mesh.faces((k + 1) % 3, f)});
    }
    int count = 0;
    for (const auto& [a, b] : directed) count += directed.count({b, a}) == 0 ? 1 : 0;
    return count;
}

inline double signed_volume(const TriMesh& mesh) {
    double volume = 0.0;
    for (int f = 0; f < mesh.face_count(); ++f) {
        Eigen::Matrix3d m;
        for (int k = 0; k < 3; ++k) m.col(k) = mesh.vertices.col(mesh.faces(k, f));
        volume += m.determinant() / 6.0;
    }
    return volume;
}

}  // namespace coseg::test
