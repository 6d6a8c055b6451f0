#include "src/mesh/polygon_area.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace coseg {
namespace {

TEST(PolygonArea, OfTrianglesQuadsAndFacesWithoutArea) {
    const PolygonMesh mesh{.vertices = {{0, 0, 1}, {2, 0, 1}, {2, 3, 1}, {0, 3, 1}},
                           .offsets = {0, 3, 7, 10, 12},
                           .corners = {0, 1, 2, 0, 1, 2, 3, 0, 1, 1, 2, 3}};
    const std::vector<double> areas = polygon_areas(mesh);
    ASSERT_EQ(areas.size(), 4U);
    EXPECT_DOUBLE_EQ(areas[0], 3.0);
    EXPECT_DOUBLE_EQ(areas[1], 6.0);
    EXPECT_DOUBLE_EQ(areas[2], 0.0);  // two corners are the same vertex
    EXPECT_DOUBLE_EQ(areas[3], 0.0);  // two corners
}

TEST(PolygonArea, OfARegularPolygonInAnyPlane) {
    constexpr int sides = 12;
    PolygonMesh mesh{.vertices = {}, .offsets = {0, sides}, .corners = {}};
    const Eigen::Vector3d across(1.0, 2.0, -2.0);  // length 3
    const Eigen::Vector3d along(2.0, 1.0, 2.0);    // length 3, at a right angle
    for (int side = 0; side < sides; ++side) {
        const double turn = 2.0 * std::numbers::pi * side / sides;
        mesh.vertices.emplace_back(std::cos(turn) * across + std::sin(turn) * along);
        mesh.corners.push_back(side);
    }
    EXPECT_NEAR(polygon_areas(mesh)[0], 0.5 * sides * 9.0 * std::sin(2.0 * std::numbers::pi / sides), 1e-12);
}

TEST(PolygonArea, OfTinyMeshes) {
    for (const double side : {1e-60, 1e-78, 1e-100, 1e-140, 1e-200}) {
        const PolygonMesh mesh{.vertices = {{0, 0, 0}, {side, 0, 0}, {side, 3 * side, 0}, {0, side, 0}},
                               .offsets = {0, 3, 6},
                               .corners = {0, 1, 2, 0, 1, 3}};
        const std::vector<double> shares = relative_areas(mesh);
        EXPECT_DOUBLE_EQ(shares[0], 3.0 * shares[1]) << side;
        if (side > 1e-150) {
            EXPECT_NEAR(polygon_areas(mesh)[0] / side / side, 1.5, 1e-12) << side;
        }
    }
}

TEST(PolygonArea, OfAnEmptyMeshIsEmpty) { EXPECT_TRUE(polygon_areas(PolygonMesh{}).empty()); }

}  // namespace
}  // namespace coseg
