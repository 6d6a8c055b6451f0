#include <algorithm>
#include <cmath>
#include <numbers>

#include "src/families/family_recipes.hpp"

namespace coseg {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// A limb of two straight pieces: thigh and shin, upper and lower arm.
PrimitivePointer limb(const Vector3d& root, const Vector3d& joint, const Vector3d& end, double root_radius,
                      double end_radius) {
    return round_chain(
        {ball(root, root_radius), ball(joint, 0.5 * (root_radius + end_radius)), ball(end, end_radius)});
}

/// In the vertical plane along x: 0 points down, positive forward.
Vector3d swing(double angle) { return {std::sin(angle), 0.0, -std::cos(angle)}; }

}  // namespace

namespace {

struct Trunk {
    double half_length, hip_radius, chest_radius, height;
};

void add_walking_legs(ImplicitShape& shape, SeededStream& random, const Trunk& trunk, double length) {
    const double radius = random.uniform(0.042, 0.062);
    // Legs stay clear.
    const double stride = random.uniform(0.05, 0.45) * std::min(1.0, 1.2 * trunk.half_length / length);
    const double phase = random.uniform(0.0, 2.0 * std::numbers::pi);
    for (int i = 0; i < 4; ++i) {
        const bool front = i < 2;
        const double side = i % 2 == 0 ? 1.0 : -1.0;
        const double trunk_radius = front ? trunk.chest_radius : trunk.hip_radius;
        const double angle = stride * std::sin(phase + std::numbers::pi * (i == 1 || i == 2 ? 1.0 : 0.0));
        const Vector3d root((front ? 0.82 : -0.82) * trunk.half_length, side * 0.62 * trunk_radius,
                            trunk.height - 0.45 * trunk_radius);
        const double reach = length + 0.2 * trunk_radius;
        const double bend = front ? -0.12 : 0.18;
        const Vector3d knee = root + 0.52 * reach * swing(angle + bend);
        const Vector3d foot = knee + 0.5 * reach * swing(angle - bend - 0.1);
        shape.add(2, 0.025, limb(root, knee, foot, 1.15 * radius, 0.72 * radius));
    }
}

void add_neck_and_head(ImplicitShape& shape, SeededStream& random, const Trunk& trunk, bool ears) {
    const double rise = random.uniform(0.35, 1.25);
    const double neck = random.uniform(0.12, 0.45);
    const double skull = random.uniform(0.085, 0.12);
    const double snout = random.uniform(0.1, 0.2);
    const Vector3d root(0.9 * trunk.half_length, 0, trunk.height + 0.35 * trunk.chest_radius);
    const Vector3d heading(std::cos(rise), 0, std::sin(rise));
    const Vector3d top = root + (neck + 0.5 * trunk.chest_radius) * heading;
    const double droop = random.uniform(-0.7, 0.1);
    const Vector3d nose = top + snout * Vector3d(std::cos(droop), 0, std::sin(droop));
    shape.add(1, 0.03, round_chain({ball(root, 0.62 * trunk.chest_radius), ball(top, 0.75 * skull)}));
    shape.add(1, 0.03, round_chain({ball(top, skull), ball(nose, 0.6 * skull)}));
    if (!ears) return;
    const double length = random.uniform(0.07, 0.16);
    for (const double side : {1.0, -1.0}) {
        const Vector3d foot = top + Vector3d(-0.35 * skull, 0.6 * side * skull, 0.6 * skull);
        const Vector3d tip = foot + length * Vector3d(-0.35, 0.45 * side, 0.85);
        shape.add(1, 0.022, flat_chain({ball(foot, 0.04), ball(tip, 0.03)}, Vector3d::UnitX(), 1.5));
    }
}

void add_tail(ImplicitShape& shape, SeededStream& random, const Trunk& trunk) {
    const double length = random.uniform(0.22, 0.5);
    const double lift = random.uniform(-0.9, 0.7);
    const double curl = random.uniform(-1.0, 1.2);
    const double swerve = random.uniform(-0.4, 0.4);
    const double radius = random.uniform(0.034, 0.045);
    Vector3d p(-trunk.half_length - 0.75 * trunk.hip_radius, 0, trunk.height + 0.4 * trunk.hip_radius);
    std::vector<ChainSphere> path;
    constexpr int steps = 6;
    for (int i = 0; i <= steps; ++i) {
        path.push_back(ball(p, radius * (1.0 - 0.35 * i / steps)));
        const double angle = lift + curl * i / steps;
        p += length / steps * Vector3d(-std::cos(angle), std::sin(swerve) * i / steps, std::sin(angle));
    }
    shape.add(3, 0.022, round_chain(path));
}

}  // namespace

ImplicitShape make_quadruped(SeededStream& random, int index) {
    Trunk trunk{random.uniform(0.26, 0.48), random.uniform(0.12, 0.17), random.uniform(0.13, 0.19), 0.0};
    const double legs = random.uniform(0.28, 0.6);
    trunk.height = legs + trunk.chest_radius;
    ImplicitShape shape;
    const double sag = random.uniform(-0.03, 0.04);
    shape.add(0, 0.0,
              round_chain(
                  smooth_path({ball({-trunk.half_length, 0, trunk.height}, trunk.hip_radius),
                               ball({0, 0, trunk.height - sag}, random.uniform(0.85, 1.0) * trunk.hip_radius),
                               ball({trunk.half_length, 0, trunk.height}, trunk.chest_radius)},
                              3)));
    add_neck_and_head(shape, random, trunk, index % 3 != 1);
    add_walking_legs(shape, random, trunk, legs);
    add_tail(shape, random, trunk);
    return shape;
}

namespace {

void add_human_arm(ImplicitShape& shape, SeededStream& random, const Vector3d& shoulder, double side,
                   double length, double radius) {
    const double raise = random.uniform(0.45, 2.2);  // from hanging down, in the plane of the body
    const double forward = random.uniform(-0.3, 0.7);
    const double bend = random.uniform(0.0, 0.9);
    const Vector3d upper(std::sin(forward), side * std::sin(raise) * std::cos(forward),
                         -std::cos(raise) * std::cos(forward));
    const Vector3d lower = (upper + bend * Vector3d(0.8, 0.25 * side, 0.3)).normalized();
    const Vector3d elbow = shoulder + 0.5 * length * upper;
    const Vector3d wrist = elbow + 0.45 * length * lower;
    const Vector3d hand = wrist + 0.16 * length * lower;
    shape.add(2, 0.025, limb(shoulder, elbow, wrist, radius, 0.75 * radius));
    shape.add(2, 0.025,
              round_chain({ball(wrist + 0.3 * (hand - wrist), 0.9 * radius), ball(hand, 0.85 * radius)}));
}

void add_human_leg(ImplicitShape& shape, SeededStream& random, const Vector3d& hip, double side,
                   double length, double radius) {
    const double stride = random.uniform(-0.35, 0.5);
    const double spread = random.uniform(0.08, 0.3);
    const double bend = random.uniform(0.0, 0.5);
    const Vector3d knee =
        hip + 0.5 * length * (swing(stride) + spread * side * Vector3d::UnitY()).normalized();
    const Vector3d ankle =
        knee + 0.46 * length * (swing(stride - bend) + 0.5 * spread * side * Vector3d::UnitY()).normalized();
    const double heading = stride - bend;
    const Vector3d toe = ankle + 0.15 * length * Vector3d(std::cos(heading), 0.15 * side, std::sin(heading));
    shape.add(3, 0.025, limb(hip, knee, ankle, radius, 0.6 * radius));
    shape.add(3, 0.025, round_chain({ball(ankle, 0.62 * radius), ball(toe, 0.55 * radius)}));
}

}  // namespace

ImplicitShape make_human(SeededStream& random, int) {
    const double shoulder = random.uniform(0.13, 0.19);
    const double waist = random.uniform(0.095, 0.14);
    const double hip = random.uniform(0.1, 0.13);
    const double torso = random.uniform(0.34, 0.46);
    const double leg = random.uniform(0.6, 0.82);
    const double head = random.uniform(0.095, 0.13);
    const double base = leg + 0.05;
    const double limb_radius = random.uniform(0.045, 0.06);
    ImplicitShape shape;
    shape.add(
        1, 0.0,
        flat_chain(smooth_path({ball({0, 0, base}, hip + 0.03), ball({0, 0, base + 0.45 * torso}, waist),
                                ball({0, 0, base + 0.85 * torso}, shoulder)},
                               3),
                   Vector3d::UnitX(), random.uniform(1.25, 1.5)));
    const double top = base + 0.85 * torso + shoulder;
    const Vector3d middle(random.uniform(0.0, 0.03), 0, top + 0.045 + head);
    shape.add(0, 0.025, round_chain({ball({0, 0, top - 0.03}, 0.52 * head), ball(middle, 0.5 * head)}));
    shape.add(0, 0.025, ellipsoid(frame_at(middle), {0.95 * head, 0.85 * head, 1.15 * head}));
    const double arm = random.uniform(0.5, 0.64);
    for (const double side : {1.0, -1.0}) {
        add_human_arm(shape, random, {0, side * (shoulder - 0.01), base + 0.9 * torso}, side, arm,
                      0.95 * limb_radius);
        add_human_leg(shape, random, {0, side * 0.62 * hip, base - 0.4 * hip}, side, leg, 1.25 * limb_radius);
    }
    return shape;
}

namespace {

void add_ant_leg(ImplicitShape& shape, SeededStream& random, const Vector3d& root, double heading,
                 double side, double floor) {
    const double length = random.uniform(0.36, 0.44);
    const double turned = heading + random.uniform(-0.1, 0.1);
    const Vector3d out(std::sin(turned), side * std::cos(turned), 0.0);
    const double radius = 0.034;
    const Vector3d knee = root + 0.5 * length * out + Vector3d(0, 0, random.uniform(0.1, 0.2));
    Vector3d foot = root + 1.05 * length * out;
    foot[2] = floor;
    shape.add(3, 0.03,
              round_chain({ball(root, 1.1 * radius), ball(knee, radius), ball(foot, 0.8 * radius),
                           ball(foot + 0.09 * out, 0.75 * radius)}));
}

}  // namespace

ImplicitShape make_ant(SeededStream& random, int) {
    const double thorax = random.uniform(0.2, 0.25);
    const double girth = random.uniform(0.085, 0.11);
    const double abdomen = random.uniform(0.19, 0.3);
    const double head = random.uniform(0.11, 0.15);
    const double lift = random.uniform(-0.5, 0.35);
    ImplicitShape shape;
    shape.add(1, 0.0, ellipsoid(frame_at(Vector3d::Zero()), {thorax, girth, girth}));
    const Vector3d head_at(thorax + 0.78 * head, 0, random.uniform(-0.03, 0.05));
    shape.add(0, 0.035, ellipsoid(frame_at(head_at), {head, random.uniform(0.8, 1.1) * head, 0.8 * head}));
    const Vector3d back(-std::cos(lift), 0, std::sin(lift));
    const Vector3d abdomen_at = Vector3d(-0.85 * thorax, 0, 0) + 0.9 * abdomen * back;
    const double fat = abdomen * random.uniform(0.6, 0.8);
    Eigen::Isometry3d pose = frame_along(abdomen_at, back);
    shape.add(2, 0.035, ellipsoid(pose, {fat, fat, abdomen}));
    const double floor = -random.uniform(0.25, 0.36);
    for (const double side : {1.0, -1.0}) {
        for (int i = -1; i <= 1; ++i)
            add_ant_leg(shape, random, {0.5 * i * thorax, 0.6 * side * girth, -0.4 * girth}, 0.65 * i, side,
                        floor);
        const Vector3d root = head_at + Vector3d(0.55 * head, 0.4 * side * head, 0.45 * head);
        const Vector3d elbow = root + Vector3d(random.uniform(0.06, 0.14), side * random.uniform(0.08, 0.14),
                                               random.uniform(0.1, 0.16));
        const Vector3d tip = elbow + Vector3d(random.uniform(0.12, 0.22), side * random.uniform(0.0, 0.12),
                                              random.uniform(-0.12, 0.06));
        shape.add(4, 0.022, round_chain({ball(root, 0.03), ball(elbow, 0.028), ball(tip, 0.026)}));
    }
    return shape;
}

ImplicitShape make_octopus(SeededStream& random, int index) {
    const int arms = 5 + index % 4;
    const double width = random.uniform(0.2, 0.28);
    const double height = width * random.uniform(0.95, 1.6);
    const double radius = std::min(random.uniform(0.058, 0.072), 1.75 * width / arms);  // roots stay apart
    ImplicitShape shape;
    const double tilt = random.uniform(-0.3, 0.3);
    const Vector3d up(std::sin(tilt), 0, std::cos(tilt));
    shape.add(0, 0.0, ellipsoid(frame_along(0.72 * height * up, up), {width, width, height}));
    const double start = random.uniform(0.0, 1.0);
    for (int a = 0; a < arms; ++a) {
        const double heading = 2.0 * std::numbers::pi * (a + start) / arms;
        const double length = random.uniform(0.55, 0.85);
        const double curl = random.uniform(-0.5, 0.5);
        const double wave = random.uniform(0.0, 0.14);
        const double rise = random.uniform(-0.35, 0.1);
        constexpr int steps = 9;
        Vector3d p(0.8 * width * std::cos(heading), 0.8 * width * std::sin(heading), 0.02);
        std::vector<ChainSphere> path{ball({0.6 * p[0], 0.6 * p[1], 0.04}, 0.6 * radius)};
        for (int i = 0; i <= steps; ++i) {
            const double t = static_cast<double>(i) / steps;
            path.push_back(ball(p, radius * (1.0 - 0.55 * t)));
            const Vector2d d = direction(heading + curl * t * t);
            p += length / steps *
                 Vector3d(d[0], d[1],
                          rise * (1.0 - t) + 6.0 * wave * std::sin(2.0 * std::numbers::pi * t) * t);
        }
        shape.add(1, 0.03, round_chain(path));
    }
    return shape;
}

}  // namespace coseg
