#include "src/mesh/turned_polygons.hpp"

#include <gtest/gtest.h>

namespace coseg {
namespace {

TEST(TurnedPolygons, KeepTheirOuterSideWhereTheyAreMirrored) {
    const PolygonMesh mesh{{{0, 0, 0}, {1, 0, 0}, {1, 2, 0}, {0, 2, 0}}, {0, 3, 7}, {0, 1, 2, 0, 1, 2, 3}};
    Eigen::Matrix3d turn;
    turn << 0, -1, 0, 1, 0, 0, 0, 0, 1;
    const PolygonMesh turned_mesh = turned(mesh, turn);
    EXPECT_EQ(turned_mesh.vertices[2], Eigen::Vector3d(-2, 1, 0));
    EXPECT_EQ(turned_mesh.corners, mesh.corners);
    const PolygonMesh mirrored = turned(mesh, Eigen::Vector3d(1, 1, -1).asDiagonal());
    EXPECT_EQ(mirrored.corners, (std::vector<int>{2, 1, 0, 3, 2, 1, 0}));
}

}  // namespace
}  // namespace coseg
