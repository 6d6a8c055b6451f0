#pragma once
// A solid made of labelled parts: a smooth union of distance primitives.

#include <Eigen/Geometry>
#include <vector>

#include "src/families/distance_primitives.hpp"

namespace coseg {

class ImplicitShape {
  public:
    /// Joins a primitive to what is there. The seam is filled within about `blend` of the crease; 0 gives a
    /// sharp crease. Keep `blend` well under the part's thickness, so that the crease stays visibly concave.
    void add(int label, double blend, PrimitivePointer primitive);

    /// Negative inside. Its gradient is at most 1 outside, up to the accuracy of the primitives. Source: the
    /// quadratic polynomial smooth minimum of I. Quilez, applied to one primitive after the other in the
    /// order of add.
    [[nodiscard]] double distance(const Eigen::Vector3d& point) const;

    /// The label of the primitive that is nearest to `point` when nothing is blended. Of two at the same
    /// distance it is the earlier one.
    [[nodiscard]] int nearest_label(const Eigen::Vector3d& point) const;

    /// A point of the surface near `point`, found by a few Newton steps along the gradient.
    [[nodiscard]] Eigen::Vector3d project(const Eigen::Vector3d& point) const;

    [[nodiscard]] Eigen::AlignedBox3d bounds() const { return bounds_; }     ///< holds the whole surface
    [[nodiscard]] double thickness() const { return thickness_; }            ///< of the thinnest primitive
    [[nodiscard]] double smallest_blend() const { return smallest_blend_; }  ///< of those above zero

  private:
    struct Part {
        PrimitivePointer primitive;
        int label;
        double blend;
        Eigen::Vector3d centre;  ///< of a ball that holds the primitive
        double radius;
    };
    [[nodiscard]] Eigen::Vector3d gradient(const Eigen::Vector3d& point, double step) const;

    std::vector<Part> parts_;
    Eigen::AlignedBox3d bounds_;
    double thickness_ = 1e300;
    double smallest_blend_ = 1e300;
};

}  // namespace coseg
