#include "src/remesh/face_suitability.hpp"

#include <gtest/gtest.h>

#include "tests/support/shapes.hpp"

namespace coseg {
namespace {

/// A right prism over an even polygon: two fans of `sides` - 2 triangles and `sides` walls of two each.
TriMesh rod(double radius, double height, int sides) {
    TriMesh mesh;
    mesh.vertices.resize(3, 2 * sides);
    mesh.faces.resize(3, 4 * sides - 4);
    int face = 0;
    for (int i = 0; i < sides; ++i) {
        const double angle = 2.0 * M_PI * i / sides;
        mesh.vertices.col(i) << radius * std::cos(angle), radius * std::sin(angle), 0.0;
        mesh.vertices.col(sides + i) << radius * std::cos(angle), radius * std::sin(angle), height;
        const int j = (i + 1) % sides;
        mesh.faces.col(face++) << i, j, sides + j;
        mesh.faces.col(face++) << i, sides + j, sides + i;
    }
    for (int i = 1; i + 1 < sides; ++i) {
        mesh.faces.col(face++) << 0, i + 1, i;
        mesh.faces.col(face++) << sides, sides + i, sides + i + 1;
    }
    return mesh;
}

TEST(FaceSuitability, EvenMeshesHaveNoOverlongTriangles) {
    EXPECT_EQ(overlong_area_share(test::sphere(3), 50), 0.0);
    EXPECT_EQ(overlong_area_share(test::box(1.0, 1.0, 1.0, 12), 50), 0.0);
}

TEST(FaceSuitability, CountsTheAreaOfLongTrianglesWhateverTheScale) {
    // walls 2 pi r h = 0.63 of area 0.69 in all, 0.12 the side of a patch; the lids' triangles are up to 0.2
    // long
    const TriMesh thin = rod(0.1, 1.0, 64);
    EXPECT_GT(overlong_area_share(thin, 50), 0.9);
    // A single patch's side is 0.83: the walls are longer, the lids shorter.
    const double wall_share = 1.0 / (1.0 + 0.1);
    EXPECT_NEAR(overlong_area_share(thin, 1), wall_share, 1e-3);
    TriMesh large = thin;
    large.vertices *= 0x1p10;
    EXPECT_EQ(overlong_area_share(large, 50), overlong_area_share(thin, 50));
}

TEST(FaceSuitability, NoAreaIsNoNeed) {
    TriMesh point = test::sphere(0);
    point.vertices.setZero();
    EXPECT_EQ(overlong_area_share(point, 50), 0.0);
}

}  // namespace
}  // namespace coseg
