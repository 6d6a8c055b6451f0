#include "solvers/alignment/rotation_fit.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "tests/support/turned_points.hpp"

namespace coseg {
namespace {

LinkedPoints linked_points(const Eigen::Matrix3d& rotation, int wrong) {
    return test::turned_points(rotation, wrong, 3);
}

TEST(RotationFit, FindsTheRotationWhereSevenOfTenLinksAreWrong) {
    const std::vector<Eigen::Matrix3d> known = hashed_rotations(5, 11);
    for (const Eigen::Matrix3d& rotation : known) {
        const LinkedPoints points = linked_points(rotation, 7);
        const FittedRotation found = fitted(points, hashed_rotations(24, 1));
        EXPECT_LT(angle_between(found.rotation, rotation), 1.0);
        EXPECT_DOUBLE_EQ(found.agreement, agreement(points, found.rotation));
        EXPECT_GT(found.agreement, 0.3);
    }
}

TEST(RotationFit, StaysNearItsStart) {
    const Eigen::Matrix3d rotation = hashed_rotations(1, 5).front();
    const Eigen::Matrix3d near =
        Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitX()).toRotationMatrix() * rotation;
    const FittedRotation found = fitted_near(linked_points(rotation, 0), near);
    EXPECT_LT(angle_between(found.rotation, rotation), 0.1);
    EXPECT_NEAR(found.agreement, 1.0, 1e-3);
}

TEST(RotationFit, NearestRotationIsProperAlsoForAReflection) {
    const Eigen::Matrix3d mirror = Eigen::Vector3d(1.0, 1.0, -0.1).asDiagonal();
    const Eigen::Matrix3d rotation = nearest_rotation(mirror);
    EXPECT_NEAR(rotation.determinant(), 1.0, 1e-12);
    EXPECT_TRUE(rotation.isIdentity(1e-12));
}

TEST(RotationFit, TheTurnsOfAxesAre24DifferentRotations) {
    const std::vector<Eigen::Matrix3d> turns = axis_rotations();
    ASSERT_EQ(turns.size(), 24U);
    EXPECT_TRUE(turns.front().isIdentity());
    for (std::size_t a = 0; a < turns.size(); ++a) {
        EXPECT_NEAR(turns[a].determinant(), 1.0, 1e-12);
        for (std::size_t b = 0; b < a; ++b) EXPECT_GT(angle_between(turns[a], turns[b]), 89.0);
    }
}

}  // namespace
}  // namespace coseg
