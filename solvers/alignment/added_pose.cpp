#include "solvers/alignment/added_pose.hpp"

#include "solvers/alignment/pose_rounds.hpp"
#include "solvers/alignment/shape_alignment.hpp"

namespace coseg {

namespace {

ShapePose turned(const FittedRotation& best, const FittedRotation& reflected, double enough) {
    ShapePose pose;
    pose.reflected = reflected.agreement >= clearly_better * best.agreement;
    pose.rotation = pose.reflected ? Eigen::Matrix3d(-reflected.rotation) : best.rotation;
    pose.agreement = pose.reflected ? reflected.agreement : best.agreement;
    pose.found = pose.agreement >= enough;
    return pose;
}

}  // namespace

FrameOfShapes frame_of_shapes(const ShapeAlignment& alignment) {
    if (!alignment.applied()) return {alignment.agreement_before, true};
    return {alignment.agreement_after, shapes_stand_alike(alignment)};
}

AddedPose added_pose(const LinkedPoints& links, const FrameOfShapes& frame, std::uint64_t seed) {
    ShapePose as_it_stands;
    as_it_stands.found = true;
    if (!(frame.agreement > 0.0) || links.weight.size() == 0) return {as_it_stands, 0.0};
    as_it_stands.agreement = agreement(links, as_it_stands.rotation);
    const double in_file = as_it_stands.agreement;
    const double enough = enough_of_others * frame.agreement;
    const std::vector<Eigen::Matrix3d> rotations = tried_rotations(seed);
    const FittedRotation best = fitted(links, rotations);
    if (frame.as_in_files) return {turned_if_outlier(as_it_stands, best, enough), in_file};
    return {turned(best, fitted(mirrored(links), rotations), enough), in_file};
}

}  // namespace coseg
