#include "src/remesh/face_suitability.hpp"

#include <gtest/gtest.h>

#include "tests/support/shapes.hpp"

namespace coseg {
namespace {

TEST(FaceSuitability, EvenMeshesHaveNoOverlongTriangles) {
    EXPECT_EQ(overlong_area_share(test::sphere(3), 50), 0.0);
    EXPECT_EQ(overlong_area_share(test::box(1.0, 1.0, 1.0, 12), 50), 0.0);
}

TEST(FaceSuitability, CountsTheAreaOfLongTrianglesWhateverTheScale) {
    // walls 2 pi r h = 0.63 of area 0.69 in all, 0.12 the side of a patch; the lids' triangles are up to 0.2
    // long
    const TriMesh thin = test::prism(0.1, 1.0, 64);
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
