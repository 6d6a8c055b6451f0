#include <algorithm>
#include <cmath>
#include <numbers>

#include "src/families/family_recipes.hpp"

namespace coseg {

namespace {

using Eigen::Vector3d;

/// A wing from tip to tip through the plane of symmetry; half chords are the radii.
std::vector<ChainSphere> wing_spheres(const Vector3d& root, const Vector3d& tip, double root_chord,
                                      double tip_chord) {
    return {ball(mirrored(tip), 0.5 * tip_chord), ball(root, 0.5 * root_chord), ball(tip, 0.5 * tip_chord)};
}

struct Airplane {
    double radius;
    Vector3d root, tip;
    double root_chord, tip_chord;
};

Airplane add_fuselage_and_wing(ImplicitShape& shape, SeededStream& random) {
    Airplane plane{};
    plane.radius = random.uniform(0.06, 0.09);
    const double r = plane.radius;
    shape.add(0, 0.0,
              round_chain(
                  smooth_path({ball({0.5, 0, 0}, 0.45 * r), ball({0.38, 0, 0}, 0.9 * r), ball({0.2, 0, 0}, r),
                               ball({-0.15, 0, 0}, r), ball({-0.5, 0, 0.25 * r}, 0.45 * r)},
                              2)));
    const double sweep = random.uniform(-0.02, 0.3);
    const double span = random.uniform(0.42, 0.62);
    const double level = random.uniform(-0.5, 0.5) * r;
    plane.root_chord = random.uniform(0.17, 0.25);
    plane.tip_chord = plane.root_chord * random.uniform(0.42, 0.8);
    plane.root = Vector3d(random.uniform(0.0, 0.1), 0, level);
    plane.tip = plane.root + Vector3d(-sweep, span, random.uniform(-0.03, 0.08));
    shape.add(1, 0.02,
              flat_chain(wing_spheres(plane.root, plane.tip, plane.root_chord, plane.tip_chord),
                         Vector3d::UnitZ(), 4.2));
    return plane;
}

void add_airplane_tail(ImplicitShape& shape, SeededStream& random, double r, bool high) {
    const double height = random.uniform(0.16, 0.24);
    const double lean = random.uniform(0.03, 0.1);
    const double chord = random.uniform(0.11, 0.15);
    const Vector3d foot(-0.42, 0, 0.25 * r);
    const Vector3d fin_foot = foot + Vector3d(0, 0, 0.3 * chord);
    const Vector3d top = foot + Vector3d(-lean, 0, height);
    shape.add(4, 0.018,
              flat_chain({ball(fin_foot, 0.5 * chord), ball(top, 0.38 * chord)}, Vector3d::UnitY(), 3.2));
    const Vector3d root = high ? Vector3d(top + Vector3d(-0.01, 0, 0)) : foot;
    const Vector3d tip =
        root + Vector3d(-random.uniform(0.02, 0.1), random.uniform(0.16, 0.24), random.uniform(0.0, 0.03));
    shape.add(2, 0.018,
              flat_chain(wing_spheres(root, tip, 0.9 * chord, 0.65 * chord), Vector3d::UnitZ(), 3.2));
}

void add_engines_under_wing(ImplicitShape& shape, SeededStream& random, const Airplane& plane, int per_side) {
    const double radius = random.uniform(0.032, 0.042) * (per_side == 1 ? 1.0 : 0.88);
    for (int e = 0; e < per_side; ++e) {
        const double share = per_side == 1 ? random.uniform(0.42, 0.55) : 0.38 + 0.32 * e;
        const Vector3d on_wing = plane.root + share * (plane.tip - plane.root);
        const double chord = plane.root_chord + share * (plane.tip_chord - plane.root_chord);
        const Vector3d middle = on_wing + Vector3d(0.42 * chord, 0, -0.5 * chord / 4.2 - 0.4 * radius);
        const std::vector<ChainSphere> pod{ball(middle + Vector3d(0.055, 0, 0), 0.9 * radius),
                                           ball(middle - Vector3d(0.055, 0, 0), 0.8 * radius)};
        shape.add(3, 0.016, round_chain(pod));
        shape.add(3, 0.016, round_chain(mirrored(pod)));
    }
}

void add_engines_at_rear(ImplicitShape& shape, SeededStream& random, double r) {
    const double radius = random.uniform(0.032, 0.04);
    const Vector3d middle(-0.27, 0.62 * r + 0.7 * radius, 0.25 * r);
    const std::vector<ChainSphere> pod{ball(middle + Vector3d(0.06, 0, 0), radius),
                                       ball(middle - Vector3d(0.05, 0, 0), 0.85 * radius)};
    shape.add(3, 0.016, round_chain(pod));
    shape.add(3, 0.016, round_chain(mirrored(pod)));
}

}  // namespace

ImplicitShape make_airplane(SeededStream& random, int index) {
    ImplicitShape shape;
    const Airplane plane = add_fuselage_and_wing(shape, random);
    const int engines = index % 5;  // two under the wing, none, four, two at the rear, two under the wing
    add_airplane_tail(shape, random, plane.radius, engines == 3 || random.uniform() < 0.2);
    if (engines == 3)
        add_engines_at_rear(shape, random, plane.radius);
    else if (engines != 1)
        add_engines_under_wing(shape, random, plane, engines == 2 ? 2 : 1);
    return shape;
}

ImplicitShape make_pliers(SeededStream& random, int index) {
    const double opening = random.uniform(0.16, 0.36);
    const double spread = opening + random.uniform(0.1, 0.25);
    const double handle_length = random.uniform(0.55, 0.9);
    const double handle_radius = random.uniform(0.042, 0.06);
    const double bow = random.uniform(-0.02, 0.1);
    const bool slender = index % 2 == 1;
    const double jaw_length = slender ? random.uniform(0.38, 0.55) : random.uniform(0.24, 0.36);
    const double jaw_root = random.uniform(0.06, 0.075);
    const double jaw_tip = slender ? random.uniform(0.024, 0.03) : random.uniform(0.035, 0.045);
    const double joint = random.uniform(0.105, 0.135);
    const double half_height = random.uniform(0.052, 0.068);
    ImplicitShape shape;
    shape.add(1, 0.0,
              revolved_solid(
                  frame_at({0, 0, -half_height}),
                  {{0, 0}, {joint - 0.02, 0}, {joint - 0.02, 2 * half_height}, {0, 2 * half_height}}, 0.02));
    for (const double side : {1.0, -1.0}) {
        const auto jaw_point = [&](double x, double y) { return Vector3d(x, side * y, 0); };
        // The jaw's inner edge turns about the pivot by the opening; its middle line lies a radius further
        // out.
        const Vector3d root = jaw_point(0.5 * joint, 0.9 * jaw_root);
        const Vector3d tip = root + jaw_point(jaw_length * std::cos(opening),
                                              jaw_length * std::sin(opening) - 0.5 * (jaw_root - jaw_tip));
        shape.add(0, 0.03,
                  flat_chain({ball(root, jaw_root), ball(tip, jaw_tip)}, Vector3d::UnitZ(),
                             std::min(1.6, jaw_root / (0.8 * half_height))));
        const Vector3d start = jaw_point(-0.55 * joint, 0.6 * joint);
        const Vector3d end = jaw_point(-0.55 * joint - handle_length * std::cos(spread),
                                       0.6 * joint + handle_length * std::sin(spread));
        const Vector3d middle = 0.5 * (start + end) + jaw_point(0.0, bow + 0.02);
        shape.add(2, 0.03,
                  round_chain(smooth_path({ball(start, 0.75 * handle_radius), ball(middle, handle_radius),
                                           ball(end, 0.9 * handle_radius)},
                                          5)));
    }
    return shape;
}

}  // namespace coseg
