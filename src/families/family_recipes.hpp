#pragma once
// Says how a shape of each family is put together. Only shape_families.cpp uses it.
//
// Each recipe draws proportions, pose and parts from `random`. `index` decides what must not be left to
// chance, such as whether there is a handle, so that a small collection has both. Labels are indices into the
// family's list.

#include <Eigen/Geometry>
#include <vector>

#include "src/base/seeded_random.hpp"
#include "src/families/distance_primitives.hpp"
#include "src/families/implicit_shape.hpp"

namespace coseg {

ImplicitShape make_cup(SeededStream& random, int index);        // body, handle
ImplicitShape make_goblet(SeededStream& random, int index);     // bowl, stem, base
ImplicitShape make_table(SeededStream& random, int index);      // top, leg
ImplicitShape make_chair(SeededStream& random, int index);      // seat, leg, back
ImplicitShape make_lamp(SeededStream& random, int index);       // base, pole, shade
ImplicitShape make_airplane(SeededStream& random, int index);   // fuselage, wing, stabilizer, engine, fin
ImplicitShape make_pliers(SeededStream& random, int index);     // jaw, joint, handle
ImplicitShape make_quadruped(SeededStream& random, int index);  // body, head, leg, tail
ImplicitShape make_human(SeededStream& random, int index);      // head, torso, arm, leg
ImplicitShape make_ant(SeededStream& random, int index);        // head, thorax, abdomen, leg, antenna
ImplicitShape make_octopus(SeededStream& random, int index);    // head, tentacle

/// A frame at `origin` whose z axis points along `axis` (any length but zero).
Eigen::Isometry3d frame_along(const Eigen::Vector3d& origin, const Eigen::Vector3d& axis);
inline Eigen::Isometry3d frame_at(const Eigen::Vector3d& origin) {
    return frame_along(origin, Eigen::Vector3d::UnitZ());
}

/// A Catmull-Rom curve through the spheres, with `pieces` pieces between neighbours. Radii are interpolated
/// in the same way.
std::vector<ChainSphere> smooth_path(const std::vector<ChainSphere>& through, int pieces);

inline ChainSphere ball(const Eigen::Vector3d& centre, double radius) {
    return {centre[0], centre[1], centre[2], radius};
}

/// Mirror image in the plane y = 0.
std::vector<ChainSphere> mirrored(std::vector<ChainSphere> spheres);
inline Eigen::Vector3d mirrored(const Eigen::Vector3d& p) { return {p[0], -p[1], p[2]}; }

/// Counter-clockwise outlines about the origin.
std::vector<Eigen::Vector2d> rectangle(double half_x, double half_y);
std::vector<Eigen::Vector2d> ellipse(double half_x, double half_y, int corners);

/// The unit vector (cos angle, sin angle).
Eigen::Vector2d direction(double angle);

}  // namespace coseg
