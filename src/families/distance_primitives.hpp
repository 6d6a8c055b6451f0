#pragma once
// Solids given by a signed distance. The generated shapes are built of them.

#include <Eigen/Geometry>
#include <memory>
#include <vector>

namespace coseg {

/// A solid. The distance is negative inside. Outside it is exact, or accurate to first order near the surface
/// and never more than the true distance, so that a ball of that radius does not reach the surface.
class DistancePrimitive {
  public:
    virtual ~DistancePrimitive() = default;
    [[nodiscard]] virtual double distance(const Eigen::Vector3d& point) const = 0;
    [[nodiscard]] virtual Eigen::AlignedBox3d bounds() const = 0;
    /// The smallest thickness anywhere. It bounds the spacing of a lattice that must not miss the solid.
    [[nodiscard]] virtual double thickness() const = 0;
};

using PrimitivePointer = std::unique_ptr<const DistancePrimitive>;

/// A sphere of a chain: x, y, z, radius.
using ChainSphere = Eigen::Vector4d;

/// The union of the hulls of consecutive spheres: a limb along a bent skeleton. At least one sphere,
/// radii > 0.
PrimitivePointer round_chain(const std::vector<ChainSphere>& spheres);

/// The same, thinned by `factor` >= 1 along the unit direction `thin` through the first sphere's centre.
/// Centres are given where they end up, so that a chain across `thin` keeps its skeleton and becomes a blade.
PrimitivePointer flat_chain(const std::vector<ChainSphere>& spheres, const Eigen::Vector3d& thin,
                            double factor);

/// An ellipsoid with the half axes `radii` along the pose's axes.
PrimitivePointer ellipsoid(const Eigen::Isometry3d& pose, const Eigen::Vector3d& radii);

/// A solid of revolution about the pose's z axis. `profile` holds (radius, z) from the axis to the axis,
/// counter-clockwise with the radius to the right (bottom first). The solid is grown by `rounding`.
PrimitivePointer revolved_solid(const Eigen::Isometry3d& pose, std::vector<Eigen::Vector2d> profile,
                                double rounding);

/// A wall of revolution: all points within `half_thickness` of the turned polyline `profile` of (radius, z).
PrimitivePointer revolved_wall(const Eigen::Isometry3d& pose, std::vector<Eigen::Vector2d> profile,
                               double half_thickness);

/// The polygon `outline` in the pose's xy plane, thickened by `half_thickness` to both sides, with edges and
/// corners rounded by `rounding` < half_thickness towards the inside.
PrimitivePointer extruded_polygon(const Eigen::Isometry3d& pose, std::vector<Eigen::Vector2d> outline,
                                  double half_thickness, double rounding);

}  // namespace coseg
