#pragma once
// The directions along which linked patches have the same position in their meshes.

#include <Eigen/Core>
#include <tuple>

#include "src/records/fields.hpp"

namespace coseg {

/// Directions common to the meshes, and how well the positions of linked patches agree along each.
struct PositionFrame {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();  ///< of the positions, weighted by links
    /// One direction a column. Along it the positions have mean 0 and spread 1 over the links, and the three
    /// do not covary.
    Eigen::Matrix3d directions = Eigen::Matrix3d::Identity();
    /// Canonical correlations of the two ends of a link, ascending, in [0, 1). All are near 0 where shapes
    /// are turned at random; one is near 0 along a direction to both sides of which shapes are alike.
    Eigen::Vector3d correlation = Eigen::Vector3d::Zero();
    static constexpr auto fields() {
        return std::tuple(field("mean", &PositionFrame::mean),
                          field("directions", &PositionFrame::directions),
                          field("correlation", &PositionFrame::correlation));
    }
};

}  // namespace coseg
