#include <cmath>
#include <numbers>

#include "src/families/family_recipes.hpp"

namespace coseg {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// The wall's middle line: radius as a function of the height share t in [0, 1].
struct VesselWall {
    double bottom_radius, top_radius, bulge, height, half_thickness;
    [[nodiscard]] double radius(double t) const {
        return bottom_radius + t * (top_radius - bottom_radius) + bulge * std::sin(std::numbers::pi * t);
    }
};

std::vector<Vector2d> vessel_profile(const VesselWall& wall) {
    constexpr int steps = 10;
    std::vector<Vector2d> profile{{0.0, 0.0}};
    for (int i = 0; i <= steps; ++i) {
        const double t = static_cast<double>(i) / steps;
        profile.emplace_back(wall.radius(t), t * wall.height);
    }
    return profile;
}

/// An ear on the wall's side at +x turned by `azimuth`; it bites into the wall but not through it.
std::vector<ChainSphere> ear(const VesselWall& wall, SeededStream& random, double azimuth) {
    const double radius = random.uniform(0.05, 0.075);
    const double high = random.uniform(0.68, 0.86);
    const double low = random.uniform(0.14, 0.34);
    const double reach = random.uniform(0.2, 0.36);
    const double squareness = random.uniform(0.45, 1.0);
    const Vector2d heading = direction(azimuth);
    constexpr int steps = 14;
    std::vector<ChainSphere> path;
    for (int i = 0; i <= steps; ++i) {
        const double angle = std::numbers::pi * i / steps;
        const double t = 0.5 * (high + low) + 0.5 * (high - low) * std::cos(angle);
        const double out = wall.radius(t) - 0.4 * wall.half_thickness + radius +
                           reach * std::pow(std::max(0.0, std::sin(angle)), squareness);
        path.push_back(ball({heading[0] * out, heading[1] * out, t * wall.height}, radius));
    }
    return path;
}

}  // namespace

ImplicitShape make_cup(SeededStream& random, int index) {
    const double top = random.uniform(0.34, 0.52);
    const VesselWall wall{top * random.uniform(0.62, 1.0), top, random.uniform(-0.03, 0.09),
                          random.uniform(0.75, 1.15), random.uniform(0.032, 0.045)};
    ImplicitShape shape;
    shape.add(0, 0.0, revolved_wall(frame_at(Vector3d::Zero()), vessel_profile(wall), wall.half_thickness));
    const int handles = index % 4 == 3 ? 0 : index % 8 == 6 ? 2 : 1;
    for (int h = 0; h < handles; ++h)
        shape.add(1, 0.03, round_chain(ear(wall, random, h * std::numbers::pi)));
    return shape;
}

ImplicitShape make_goblet(SeededStream& random, int index) {
    const double stem_radius = random.uniform(0.04, 0.06);
    const double stem_height = random.uniform(0.25, 0.65);
    const double base_radius = random.uniform(0.22, 0.34);
    const double base_height = random.uniform(0.04, 0.14);
    const double bowl_radius = random.uniform(0.24, 0.4);
    const VesselWall bowl{bowl_radius * random.uniform(0.35, 0.7), bowl_radius, random.uniform(0.02, 0.14),
                          random.uniform(0.35, 0.75), random.uniform(0.026, 0.034)};
    ImplicitShape shape;
    const double bottom = base_height + stem_height;
    shape.add(0, 0.0, revolved_wall(frame_at({0, 0, bottom}), vessel_profile(bowl), bowl.half_thickness));
    shape.add(1, 0.03,
              round_chain({ball({0, 0, 0.5 * base_height}, stem_radius),
                           ball({0, 0, bottom - 0.5 * stem_radius}, stem_radius)}));
    if (index % 3 == 1) {
        const double knob = stem_radius * random.uniform(1.5, 2.1);
        shape.add(1, 0.03,
                  round_chain({ball({0, 0, base_height + stem_height * random.uniform(0.4, 0.65)}, knob)}));
    }
    const double rounding = 0.028;
    const double slope = index % 2 == 0 ? base_height : 0.02;
    shape.add(
        2, 0.03,
        revolved_solid(frame_at(Vector3d::Zero()),
                       {{0, 0}, {base_radius, 0}, {base_radius, 0.01}, {stem_radius, slope}, {0, slope}},
                       rounding));
    return shape;
}

}  // namespace coseg
