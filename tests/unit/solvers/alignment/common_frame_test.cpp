#include "solvers/alignment/common_frame.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "solvers/alignment/rotation_fit.hpp"

namespace coseg {
namespace {

ShapePose pose_of(const Eigen::Matrix3d& rotation) {
    ShapePose pose;
    pose.rotation = rotation;
    pose.found = true;
    return pose;
}

/// Patches of a table that stands on four legs along -z: the top has most of the area.
Eigen::Matrix3Xd table_patches() {
    Eigen::Matrix3Xd positions(3, 20);
    int p = 0;
    for (const double x : {-2.0, -0.7, 0.7, 2.0}) {
        for (const double y : {-1.0, 0.0, 1.0}) positions.col(p++) = Eigen::Vector3d(x, y, 0.5);
    }
    for (const double z : {-0.8, -2.0}) {
        for (const double x : {-2.0, 2.0}) {
            for (const double y : {-1.0, 1.0}) positions.col(p++) = Eigen::Vector3d(x, y, z);
        }
    }
    return positions;
}

TEST(CommonFrame, LeavesMostShapesAsTheyStand) {
    const std::vector<Eigen::Matrix3d> g = hashed_rotations(3, 4);
    const Eigen::Matrix3d shaken = Eigen::AngleAxisd(0.05, Eigen::Vector3d::UnitX()) * g[0];
    const std::vector<ShapePose> poses{pose_of(g[1]), pose_of(g[0]), pose_of(shaken), pose_of(g[2])};
    const Eigen::Matrix3Xd positions = Eigen::Matrix3Xd::Zero(3, 4);
    const std::vector<int> mesh_of{0, 1, 2, 3};
    const std::vector<double> area(4, 1.0);
    const Eigen::Matrix3d frame = common_frame(poses, {positions, mesh_of, area});
    EXPECT_NEAR(frame.determinant(), 1.0, 1e-12);
    EXPECT_LT(angle_between(frame * g[0], Eigen::Matrix3d::Identity()), 3.0);
}

TEST(CommonFrame, MakesTurnedTablesStandOnTheirLegs) {
    const Eigen::Matrix3Xd table = table_patches();
    const std::vector<Eigen::Matrix3d> turns = hashed_rotations(3, 6);
    Eigen::Matrix3Xd positions(3, 3 * table.cols());
    std::vector<int> mesh_of;
    std::vector<ShapePose> poses;
    const Eigen::Matrix3d somewhere = hashed_rotations(1, 77).front();
    for (int m = 0; m < 3; ++m) {
        positions.middleCols(m * table.cols(), table.cols()) = turns[static_cast<std::size_t>(m)] * table;
        mesh_of.insert(mesh_of.end(), static_cast<std::size_t>(table.cols()), m);
        poses.push_back(pose_of(somewhere * turns[static_cast<std::size_t>(m)].transpose()));
    }
    const std::vector<double> area(mesh_of.size(), 1.0);
    const Eigen::Matrix3d frame = common_frame(poses, {positions, mesh_of, area});
    EXPECT_NEAR(frame.determinant(), 1.0, 1e-12);
    const Eigen::Vector3d up = frame * somewhere * Eigen::Vector3d::UnitZ();
    const Eigen::Vector3d long_side = frame * somewhere * Eigen::Vector3d::UnitX();
    EXPECT_NEAR(up.y(), 1.0, 1e-6);
    EXPECT_NEAR(std::abs(long_side.x()), 1.0, 1e-6);
}

}  // namespace
}  // namespace coseg
