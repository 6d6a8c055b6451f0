#pragma once
// The tetrahedron that small files of every format hold, so that readers can be held against each other.

#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "io/mesh_files/parsed_mesh.hpp"

namespace coseg::test {

/// Expects the faces (O Y X), (O X Z), (O Z Y), (X Y Z) of the corners O = 0, X, Y and Z = unit vectors, in
/// this order whatever the numbers of the vertices, no other vertex, and no warning.
inline void expect_tetrahedron(const ParsedMesh& parsed) {
    const PolygonMesh& mesh = parsed.mesh;
    const Eigen::Vector3d o(0, 0, 0);
    const Eigen::Vector3d x(1, 0, 0);
    const Eigen::Vector3d y(0, 1, 0);
    const Eigen::Vector3d z(0, 0, 1);
    EXPECT_EQ(mesh.offsets, (std::vector<int>{0, 3, 6, 9, 12}));
    std::vector<Eigen::Vector3d> corners;
    for (const int corner : mesh.corners)
        corners.push_back(mesh.vertices.at(static_cast<std::size_t>(corner)));
    EXPECT_EQ(corners, (std::vector<Eigen::Vector3d>{o, y, x, o, x, z, o, z, y, x, y, z}));
    EXPECT_EQ(std::set<int>(mesh.corners.begin(), mesh.corners.end()).size(), 4U);
    EXPECT_EQ(mesh.vertex_count(), 4);
    EXPECT_EQ(parsed.warnings, std::vector<std::string>{});
}

}  // namespace coseg::test
