#include "solvers/alignment/rotation_fit.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "src/base/seeded_random.hpp"

namespace coseg {
namespace {

/// Points without any symmetry, turned by `rotation`; of every ten links `wrong` lead to another point.
LinkedPoints linked_points(const Eigen::Matrix3d& rotation, int wrong) {
    constexpr int count = 200;
    SeededStream random(3);
    LinkedPoints points{Eigen::Matrix3Xd(3, count), Eigen::Matrix3Xd(3, count),
                        Eigen::VectorXd::Constant(count, 1.0 / count)};
    for (int k = 0; k < count; ++k)
        points.own.col(k) =
            Eigen::Vector3d(2.0 * random.normal(), random.normal(), 0.5 * random.normal() + random.uniform());
    for (int k = 0; k < count; ++k) {
        const int other = k % 10 < wrong ? static_cast<int>(random() % count) : k;
        points.other.col(k) = rotation * points.own.col(other);
    }
    return points;
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
