#pragma once
// What tests ask of triangle meshes as surfaces.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include "src/mesh/dual_graph.hpp"
#include "src/mesh/face_geometry.hpp"
#include "src/mesh/tri_mesh.hpp"

namespace coseg::test {

/// Every edge has exactly two faces, which run along it in opposite directions.
inline bool is_closed_and_oriented(const TriMesh& mesh) {
    std::set<std::pair<int, int>> halfedges;
    for (int f = 0; f < mesh.face_count(); ++f) {
        for (int c = 0; c < 3; ++c) {
            if (!halfedges.emplace(mesh.faces(c, f), mesh.faces((c + 1) % 3, f)).second) return false;
        }
    }
    return std::all_of(halfedges.begin(), halfedges.end(), [&](const auto& h) {
        return halfedges.count({h.second, h.first}) == 1;
    });
}

/// The faces about every vertex form one closed fan, and every vertex has faces. The mesh must be closed.
inline bool has_single_fans(const TriMesh& mesh) {
    std::vector<std::map<int, int>> next(static_cast<std::size_t>(mesh.vertex_count()));
    for (int f = 0; f < mesh.face_count(); ++f) {
        for (int c = 0; c < 3; ++c)
            next[mesh.faces(c, f)][mesh.faces((c + 1) % 3, f)] = mesh.faces((c + 2) % 3, f);
    }
    return std::all_of(next.begin(), next.end(), [](const std::map<int, int>& around) {
        if (around.empty()) return false;
        std::size_t steps = 0;
        int v = around.begin()->first;
        do {
            v = around.at(v);
            ++steps;
        } while (v != around.begin()->first && steps <= around.size());
        return steps == around.size();
    });
}

inline int component_count(const TriMesh& mesh) {
    const std::vector<int> components = face_components(dual_graph(mesh, face_geometry(mesh)));
    return 1 + *std::max_element(components.begin(), components.end());
}

/// V - E + F of a closed mesh without unused vertices.
inline int euler_characteristic(const TriMesh& mesh) { return mesh.vertex_count() - mesh.face_count() / 2; }

/// Positive where faces are counter-clockwise from outside.
inline double volume(const TriMesh& mesh) {
    double sum = 0.0;
    for (int f = 0; f < mesh.face_count(); ++f) {
        const Eigen::Vector3d a = mesh.vertices.col(mesh.faces(0, f));
        const Eigen::Vector3d b = mesh.vertices.col(mesh.faces(1, f));
        const Eigen::Vector3d c = mesh.vertices.col(mesh.faces(2, f));
        sum += a.dot(b.cross(c)) / 6.0;
    }
    return sum;
}

/// The smallest angle of every face in degrees, ascending.
inline std::vector<double> smallest_angles(const TriMesh& mesh) {
    std::vector<double> angles;
    for (int f = 0; f < mesh.face_count(); ++f) {
        double smallest = std::numbers::pi;
        for (int c = 0; c < 3; ++c) {
            const Eigen::Vector3d p = mesh.vertices.col(mesh.faces(c, f));
            const Eigen::Vector3d u = mesh.vertices.col(mesh.faces((c + 1) % 3, f)) - p;
            const Eigen::Vector3d v = mesh.vertices.col(mesh.faces((c + 2) % 3, f)) - p;
            smallest = std::min(smallest, std::atan2(u.cross(v).norm(), u.dot(v)));
        }
        angles.push_back(smallest * 180.0 / std::numbers::pi);
    }
    std::sort(angles.begin(), angles.end());
    return angles;
}

}  // namespace coseg::test
