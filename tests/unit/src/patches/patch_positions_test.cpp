#include "src/patches/patch_positions.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace coseg {
namespace {

/// Four faces at the corners of a square of side 2 in the plane z = 5, one of them of area 3.
FaceGeometry four_faces() {
    FaceGeometry geometry;
    geometry.area = Eigen::Vector4d(1.0, 1.0, 1.0, 3.0);
    geometry.centroid.resize(3, 4);
    geometry.centroid << 0.0, 2.0, 0.0, 2.0, 0.0, 0.0, 2.0, 2.0, 5.0, 5.0, 5.0, 5.0;
    geometry.total_area = 6.0;
    return geometry;
}

TEST(PatchPlaces, AreCentroidsByAreaInUnitsOfTheSpread) {
    const Eigen::Matrix3Xd positions = patch_positions(four_faces(), {0, 0, 1, 1}, 3);
    // Centre (4/3, 4/3, 5); squares of offsets x and y: 3 of area 6 at 4/3 and 2/3 from it ... summed by
    // hand.
    const double squares = 2.0 * (2.0 * 16.0 / 9.0 + 4.0 * 4.0 / 9.0);
    const double unit = std::sqrt(squares / 18.0);
    EXPECT_NEAR(positions(0, 0), (1.0 - 4.0 / 3.0) / unit, 1e-14);
    EXPECT_NEAR(positions(1, 0), (0.0 - 4.0 / 3.0) / unit, 1e-14);
    EXPECT_NEAR(positions(0, 1), (1.5 - 4.0 / 3.0) / unit, 1e-14);
    EXPECT_NEAR(positions(1, 1), (2.0 - 4.0 / 3.0) / unit, 1e-14);
    EXPECT_EQ(positions(2, 0), 0.0);
    EXPECT_TRUE(positions.col(2).isZero()) << "a patch without faces";
}

TEST(PatchPlaces, DoNotDependOnWhereTheMeshLiesAndHowLargeItIs) {
    const FaceGeometry geometry = four_faces();
    FaceGeometry moved = geometry;
    moved.centroid = (8.0 * geometry.centroid).colwise() + Eigen::Vector3d(3.0, -100.0, 7.0);
    moved.area *= 64.0;
    moved.total_area *= 64.0;
    const Eigen::Matrix3Xd a = patch_positions(geometry, {0, 1, 1, 2}, 3);
    const Eigen::Matrix3Xd b = patch_positions(moved, {0, 1, 1, 2}, 3);
    EXPECT_LT((a - b).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(PatchPlaces, OneFaceAloneLiesAtTheOrigin) {
    FaceGeometry geometry;
    geometry.area = Eigen::VectorXd::Ones(1);
    geometry.centroid = Eigen::Vector3d(1.0, 2.0, 3.0);
    geometry.total_area = 1.0;
    EXPECT_TRUE(patch_positions(geometry, {0}, 1).isZero());
}

}  // namespace
}  // namespace coseg
