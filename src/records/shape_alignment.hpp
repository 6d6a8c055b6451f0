#pragma once
// How each shape of a collection is to be turned so that all stand alike.

#include <Eigen/Core>
#include <string>
#include <tuple>
#include <vector>

#include "src/records/fields.hpp"

namespace coseg {

/// x -> scale * rotation * x + translation takes a shape to the common frame. x and the frame are in the
/// units of patch_positions: the origin is the centroid of the shape, the unit the root mean square of a
/// coordinate.
struct ShapePose {
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< orthogonal; of determinant -1 if reflected
    double scale = 1.0;
    Eigen::Vector3d translation = Eigen::Vector3d::Zero();
    /// Of the shape's links to others in the frame, by weight: the mean of exp(-d^2 / 2 s^2), in 0 .. 1,
    /// where d is the distance of the two ends and s = agreement_width.
    double agreement = 0.0;
    /// Root mean square of d, weighted by links and by exp(-d^2 / 2 s^2): links that lead elsewhere, as from
    /// one leg to another, do not count.
    double residual = 0.0;
    bool reflected = false;
    bool found = false;  ///< whether links to others say how it stands; else the rotation is a guess
    [[nodiscard]] bool is_turned() const { return rotation != Eigen::Matrix3d::Identity(); }
    static constexpr auto fields() {
        return std::tuple(field("rotation", &ShapePose::rotation), field("scale", &ShapePose::scale),
                          field("translation", &ShapePose::translation),
                          field("agreement", &ShapePose::agreement), field("residual", &ShapePose::residual),
                          field("reflected", &ShapePose::reflected), field("found", &ShapePose::found));
    }
};

/// The poses of all shapes, and by what it was decided whether they are used.
struct ShapeAlignment {
    std::vector<ShapePose> shapes;  ///< one for each mesh; none where nothing was aligned
    /// Share of the shapes whose links agree about as well as the shapes stand in their files as in the best
    /// of other orientations that were tried for each.
    double standing_share = 0.0;
    double agreement_before = 0.0;  ///< mean over the shapes, as they stand in their files
    double agreement_after = 0.0;   ///< the same in the common frame
    std::string reason;             ///< why the shapes are aligned, or are not: a phrase
    [[nodiscard]] bool applied() const noexcept { return !shapes.empty(); }
};

}  // namespace coseg
