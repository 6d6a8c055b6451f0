#include <algorithm>
#include <cmath>
#include <numbers>

#include "src/families/family_recipes.hpp"

namespace coseg {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double turn = 2.0 * std::numbers::pi;

/// Feet and heads of legs: `count` on an ellipse, or in the corners (and the long sides' middles, for six).
std::vector<Vector2d> leg_places(int count, bool in_corners, double half_x, double half_y, double start) {
    std::vector<Vector2d> places;
    if (in_corners) {
        places = rectangle(half_x, half_y);
        if (count == 6) places.insert(places.end(), {{0.0, half_y}, {0.0, -half_y}});
        return places;
    }
    for (int i = 0; i < count; ++i) {
        const Vector2d d = direction(start + turn * i / count);
        places.emplace_back(half_x * d[0], half_y * d[1]);
    }
    return places;
}

struct LegStyle {
    bool square;
    double top_radius, foot_radius;
    double splay;  ///< foot's distance from the middle over the head's
    double curve;  ///< how far the knee stands out, in units of height
};

LegStyle draw_leg_style(SeededStream& random, double radius) {
    LegStyle style{random.uniform() < 0.35, radius, std::max(0.032, radius * random.uniform(0.65, 1.05)),
                   random.uniform(0.95, 1.3), 0.0};
    if (!style.square && random.uniform() < 0.3) style.curve = random.uniform(-0.08, 0.12);
    return style;
}

struct Slab {
    double height, half_thickness;
    /// How high a rod of that radius may rise so that it stays below the slab's upper side.
    [[nodiscard]] double rod_end(double radius) const { return height + 0.4 * half_thickness - radius; }
};

PrimitivePointer leg(const LegStyle& style, const Vector2d& place, const Slab& slab) {
    const Vector3d head(place[0], place[1], slab.rod_end(style.square ? 0.0 : style.top_radius));
    const Vector3d foot(place[0] * style.splay, place[1] * style.splay, style.foot_radius);
    if (style.square) {
        const Vector3d axis = head - foot;
        return extruded_polygon(frame_along(0.5 * (head + foot), axis),
                                rectangle(0.9 * style.top_radius, 0.9 * style.top_radius), 0.5 * axis.norm(),
                                0.25 * style.top_radius);
    }
    const Vector2d out = place.norm() > 0.0 ? Vector2d(place.normalized()) : Vector2d::Zero();
    Vector3d knee = 0.5 * (head + foot);
    knee.head<2>() += style.curve * slab.height * out;
    return round_chain(
        smooth_path({ball(head, style.top_radius), ball(knee, 0.5 * (style.top_radius + style.foot_radius)),
                     ball(foot, style.foot_radius)},
                    style.curve != 0.0 ? 5 : 1));
}

/// Bars between neighbouring legs, at the share `share` of the height, of radius `smallest` at least.
void add_stretchers(ImplicitShape& shape, const LegStyle& style, std::vector<Vector2d> places, double height,
                    double share, double smallest) {
    std::sort(places.begin(), places.end(), [](const Vector2d& a, const Vector2d& b) {
        return std::atan2(a[1], a[0]) < std::atan2(b[1], b[0]);
    });
    const double radius = std::max(smallest, 0.7 * style.foot_radius);
    const auto joint = [&](const Vector2d& place) {
        const double reach =
            style.splay + share * (1.0 - style.splay) +
            (place.norm() > 0.0 ? 2.0 * style.curve * height * share * (1.0 - share) / place.norm() : 0.0);
        return Vector3d(place[0] * reach, place[1] * reach, share * height);
    };
    for (std::size_t i = 0; i < places.size(); ++i) {
        shape.add(1, 0.02,
                  round_chain({ball(joint(places[i]), radius),
                               ball(joint(places[(i + 1) % places.size()]), radius)}));
    }
}

}  // namespace

ImplicitShape make_table(SeededStream& random, int index) {
    const bool round = index % 2 == 1;
    const double half_x = random.uniform(0.45, 0.65);
    const double half_y = half_x * (round ? random.uniform(0.75, 1.0) : random.uniform(0.5, 1.0));
    const double height = random.uniform(0.45, 0.95);
    const double half_thickness = random.uniform(0.03, 0.05);
    const int legs = round ? 3 + index / 2 % 4 : (index / 2 % 3 == 2 ? 6 : 4);
    const LegStyle style = draw_leg_style(random, random.uniform(0.038, 0.06));
    const double inset = random.uniform(0.68, 0.84);
    ImplicitShape shape;
    const std::vector<Vector2d> outline = round ? ellipse(half_x, half_y, 48) : rectangle(half_x, half_y);
    shape.add(0, 0.0,
              extruded_polygon(frame_at({0, 0, height}), outline, half_thickness, 0.45 * half_thickness));
    const auto places = leg_places(legs, !round, inset * half_x, inset * half_y, random.uniform(0.0, turn));
    for (const Vector2d& place : places) shape.add(1, 0.02, leg(style, place, {height, half_thickness}));
    if (random.uniform() < 0.3)
        add_stretchers(shape, style, places, height, random.uniform(0.18, 0.4), 0.034);
    return shape;
}

namespace {

/// A panel, or posts with rails, leaning back from `foot`, the middle of the seat's rear edge (at -x).
void add_chair_back(ImplicitShape& shape, SeededStream& random, int style, const Vector3d& foot,
                    double half_width) {
    constexpr double radius = 0.032;
    const double height = random.uniform(0.38, 0.75);
    const double lean = random.uniform(0.0, 0.22);
    const Vector3d up(-std::sin(lean), 0.0, std::cos(lean));
    if (style == 0) {
        Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
        frame.linear().col(0) = Vector3d::UnitY();
        frame.linear().col(1) = up;
        frame.linear().col(2) = Vector3d::UnitY().cross(up);
        frame.translation() = foot;
        const double top_width = half_width * random.uniform(0.7, 1.0);
        std::vector<Vector2d> outline{{-half_width, 0.0}, {half_width, 0.0}, {half_width, 0.3 * height}};
        for (int i = 0; i <= 8; ++i) {
            const Vector2d d = direction(0.5 * std::numbers::pi * i / 4.0);
            outline.emplace_back(top_width * d[0], height * (0.7 + 0.3 * d[1]));
        }
        outline.emplace_back(-half_width, 0.3 * height);
        shape.add(2, 0.02, extruded_polygon(frame, outline, random.uniform(0.028, 0.036), 0.012));
        return;
    }
    const Vector3d side(0.0, half_width - radius, 0.0);
    for (const double s : {-1.0, 1.0})
        shape.add(2, 0.018,
                  round_chain({ball(foot + s * side, radius), ball(foot + s * side + height * up, radius)}));
    const int rails = height > 0.5 ? 1 + style : 1;
    for (int r = 0; r < rails; ++r) {
        const Vector3d middle = foot + height * (1.0 - 0.6 * r / rails) * up;
        shape.add(2, 0.018,
                  flat_chain({ball(middle - side, 1.3 * radius), ball(middle + side, 1.3 * radius)},
                             up.cross(Vector3d::UnitY()), 1.5));
    }
}

/// A column on a star of feet.
void add_swivel_legs(ImplicitShape& shape, SeededStream& random, const Slab& seat, double half_width) {
    const int feet = 3 + static_cast<int>(random() % 3);
    const double radius = random.uniform(0.035, 0.045);
    const double hub = random.uniform(0.12, 0.2);
    shape.add(1, 0.02,
              round_chain(
                  {ball({0, 0, seat.rod_end(1.3 * radius)}, 1.3 * radius), ball({0, 0, hub}, 1.3 * radius)}));
    for (int i = 0; i < feet; ++i) {
        const Vector2d d = direction(turn * (i + 0.5) / feet) * half_width * 1.1;
        shape.add(1, 0.02,
                  round_chain({ball({0, 0, hub}, radius), ball({d[0], d[1], radius}, 0.9 * radius)}));
    }
}

}  // namespace

ImplicitShape make_chair(SeededStream& random, int index) {
    const double half_width = random.uniform(0.24, 0.34);
    const double half_depth = random.uniform(0.24, 0.32);
    const double seat = random.uniform(0.36, 0.62);
    const double half_thickness = random.uniform(0.032, 0.06);
    const bool round = index % 5 == 2;
    ImplicitShape shape;
    shape.add(
        0, 0.0,
        extruded_polygon(frame_at({0, 0, seat}),
                         round ? ellipse(half_depth, half_width, 40) : rectangle(half_depth, half_width),
                         half_thickness, 0.5 * half_thickness));
    if (index % 6 == 4) {
        add_swivel_legs(shape, random, {seat, half_thickness}, half_width);
    } else {
        const LegStyle style = draw_leg_style(random, random.uniform(0.032, 0.042));
        const double inset = round ? 0.54 : 0.8;
        const auto places = leg_places(4, true, inset * half_depth, inset * half_width, 0.0);
        for (const Vector2d& place : places) shape.add(1, 0.018, leg(style, place, {seat, half_thickness}));
        if (random.uniform() < 0.25)
            add_stretchers(shape, style, places, seat, random.uniform(0.2, 0.45), 0.026);
    }
    if (index % 7 != 5) {
        const double shrink = round ? 0.6 : 1.0;
        const Vector3d foot(-(round ? 0.72 : 1.0) * half_depth + 0.05, 0.0, seat);
        add_chair_back(shape, random, index % 3, foot, shrink * half_width - 0.02);
    }
    return shape;
}

namespace {

/// An open cone or dome with a lid, its mouth along -axis; `apex` is in the lid.
PrimitivePointer lamp_shade(SeededStream& random, const Vector3d& apex, const Vector3d& axis, bool dome) {
    const double height = random.uniform(0.2, 0.36);
    const double mouth = random.uniform(0.2, 0.34);
    const double lid = dome ? 0.0 : mouth * random.uniform(0.35, 0.85);
    std::vector<Vector2d> profile{{0.0, 0.0}};
    if (!dome) profile.insert(profile.end(), {{lid, 0.0}, {mouth, -height}});
    for (int i = 1; dome && i <= 10; ++i) {
        const Vector2d d = direction(0.5 * std::numbers::pi * (1.0 - i / 10.0));
        profile.emplace_back(mouth * d[0], height * (d[1] - 1.0));
    }
    return revolved_wall(frame_along(apex, axis), profile, random.uniform(0.024, 0.032));
}

PrimitivePointer lamp_base(SeededStream& random, int style) {
    const double radius = random.uniform(0.16, 0.26);
    const double height = random.uniform(0.05, 0.11);
    if (style == 0) {
        return revolved_solid(
            frame_at(Vector3d::Zero()),
            {{0, 0}, {radius, 0}, {radius, 0.3 * height}, {0.35 * radius, height}, {0, height}}, 0.02);
    }
    if (style == 1)
        return extruded_polygon(frame_at({0, 0, 0.5 * height}), rectangle(radius, 0.8 * radius),
                                0.5 * height + 0.01, 0.02);
    return revolved_solid(frame_at(Vector3d::Zero()), {{0, 0}, {radius, 0}, {radius, height}, {0, height}},
                          0.02);
}

}  // namespace

ImplicitShape make_lamp(SeededStream& random, int index) {
    const int style = index % 3;  // straight, goose neck, two arms
    const double radius = random.uniform(0.026, 0.036);
    const double height = random.uniform(0.6, 1.15);
    ImplicitShape shape;
    shape.add(0, 0.0, lamp_base(random, index / 3 % 3));
    const Vector3d foot(0, 0, 0.03);
    if (style == 0) {
        const Vector3d apex(0, 0, height);
        shape.add(1, 0.028, round_chain({ball(foot, radius), ball(apex, radius)}));
        shape.add(2, 0.028, lamp_shade(random, apex, Vector3d::UnitZ(), index % 2 == 1));
        return shape;
    }
    const double reach = random.uniform(0.3, 0.5);
    double lean = random.uniform(0.3, 1.0);
    std::vector<ChainSphere> pole;
    Vector3d apex;
    if (style == 1) {
        apex = Vector3d(reach, 0, 0.78 * height);
        pole = smooth_path({ball(foot, radius), ball({-0.02, 0, 0.45 * height}, radius),
                            ball({0.15 * reach, 0, 0.9 * height}, radius),
                            ball({0.6 * reach, 0, height}, radius), ball(apex, radius)},
                           5);
    } else {
        const Vector3d elbow(-random.uniform(0.12, 0.3), 0, random.uniform(0.7, 0.9) * height);
        apex = Vector3d(reach, 0, elbow[2] + random.uniform(-0.15, 0.12));
        pole = {ball(foot, radius), ball(elbow, radius), ball(apex, radius)};
        const double rise = std::atan2(apex[2] - elbow[2], apex[0] - elbow[0]);
        lean = rise + random.uniform(0.75, 1.2);  // of the shade behind which the arm ends
    }
    shape.add(1, 0.028, round_chain(pole));
    shape.add(2, 0.028, lamp_shade(random, apex, {-std::sin(lean), 0, std::cos(lean)}, index % 2 == 0));
    return shape;
}

}  // namespace coseg
