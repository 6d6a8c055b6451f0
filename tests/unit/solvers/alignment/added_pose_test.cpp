#include "solvers/alignment/added_pose.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "solvers/alignment/shape_alignment.hpp"
#include "tests/support/turned_points.hpp"

namespace coseg {
namespace {

LinkedPoints links_of_turned_shape(const Eigen::Matrix3d& rotation, int wrong) {
    return test::turned_points(rotation, wrong, 8);
}

const Eigen::Matrix3d quarter_turn = axis_rotations()[5];

TEST(AddedPose, AShapeThatLiesOnItsSideIsTurnedAmongShapesThatStand) {
    const AddedPose added = added_pose(links_of_turned_shape(quarter_turn, 4), {0.6, true}, 1);
    EXPECT_TRUE(added.pose.found);
    EXPECT_LT(angle_between(added.pose.rotation, quarter_turn), 2.0);
    EXPECT_GT(added.pose.agreement, outlier_gain * added.agreement_in_file);
}

TEST(AddedPose, AShapeThatStandsStaysToTheLastBit) {
    const AddedPose added = added_pose(links_of_turned_shape(Eigen::Matrix3d::Identity(), 4), {0.6, true}, 1);
    EXPECT_FALSE(added.pose.is_turned());
    EXPECT_DOUBLE_EQ(added.pose.agreement, added.agreement_in_file);
}

TEST(AddedPose, AmongShapesThatStandLinksThatSayLittleTurnNothing) {
    const LinkedPoints links = links_of_turned_shape(quarter_turn, 8);
    EXPECT_TRUE(added_pose(links, {0.1, true}, 1).pose.is_turned()) << "or the test below shows nothing";
    const ShapePose pose = added_pose(links, {0.9, true}, 1).pose;
    EXPECT_FALSE(pose.is_turned());
    EXPECT_TRUE(pose.found) << "it stands as the others do, as far as can be told";
}

TEST(AddedPose, AmongTurnedShapesEveryOneIsTurnedOrNotFound) {
    const Eigen::Matrix3d small = Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitX()).toRotationMatrix();
    const ShapePose turned = added_pose(links_of_turned_shape(small, 2), {0.6, false}, 1).pose;
    EXPECT_TRUE(turned.found);
    EXPECT_LT(angle_between(turned.rotation, small), 2.0);
    EXPECT_FALSE(turned.reflected);
    EXPECT_FALSE(added_pose(links_of_turned_shape(small, 9), {0.9, false}, 1).pose.found);
}

TEST(AddedPose, AmongTurnedShapesAMirroredOneIsMirrored) {
    const Eigen::Matrix3d mirror = Eigen::Vector3d(-1.0, 1.0, 1.0).asDiagonal();
    const ShapePose pose = added_pose(links_of_turned_shape(mirror, 2), {0.6, false}, 1).pose;
    EXPECT_TRUE(pose.reflected);
    EXPECT_NEAR(pose.rotation.determinant(), -1.0, 1e-9);
    EXPECT_LT(angle_between(-pose.rotation, -mirror), 2.0);
}

TEST(AddedPose, NothingIsTurnedWhereNothingWasAligned) {
    EXPECT_FALSE(added_pose(links_of_turned_shape(quarter_turn, 0), {}, 1).pose.is_turned());
    const AddedPose unlinked = added_pose({}, {0.6, true}, 1);
    EXPECT_FALSE(unlinked.pose.is_turned());
    EXPECT_TRUE(unlinked.pose.found);
}

TEST(AddedPose, TheFrameIsThatOfTheFilesUnlessAllWereTurned) {
    ShapeAlignment alignment;
    alignment.standing_share = 0.8;
    alignment.agreement_before = 0.3;
    alignment.agreement_after = 0.4;
    EXPECT_TRUE(frame_of_shapes(alignment).as_in_files);
    EXPECT_EQ(frame_of_shapes(alignment).agreement, 0.3);
    alignment.shapes.resize(3);
    EXPECT_TRUE(frame_of_shapes(alignment).as_in_files) << "outliers alone were turned";
    EXPECT_EQ(frame_of_shapes(alignment).agreement, 0.4);
    alignment.standing_share = 0.2;
    EXPECT_FALSE(frame_of_shapes(alignment).as_in_files);
}

}  // namespace
}  // namespace coseg
