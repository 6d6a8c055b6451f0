#pragma once
// The smallest box around points, in any direction.

#include <Eigen/Core>
#include <tuple>
#include <vector>

#include "src/records/fields.hpp"

namespace coseg {

struct OrientedBox {
    Eigen::Vector3d center = Eigen::Vector3d::Zero();
    /// Columns: unit vectors, a right-handed frame, the longest side first. The largest component of each of
    /// the first two is positive.
    Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
    Eigen::Vector3d sizes = Eigen::Vector3d::Zero();  ///< along the axes, descending
    static constexpr auto fields() {
        return std::tuple(field("center", &OrientedBox::center), field("axes", &OrientedBox::axes),
                          field("sizes", &OrientedBox::sizes));
    }
};

/// A box around all points with one side across one of `directions` (of any length but 0), the coordinate
/// axes or the principal axes of the points. Among these it is the one of the least volume: exactly the
/// smallest where a face of the smallest box lies across one of them, and close to it otherwise. A box in the
/// coordinate axes is preferred to one that is smaller by less than 1e-9 of its volume. At least one point.
OrientedBox oriented_box(const std::vector<Eigen::Vector3d>& points,
                         const std::vector<Eigen::Vector3d>& directions);

}  // namespace coseg
