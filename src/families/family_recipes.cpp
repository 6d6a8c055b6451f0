#include "src/families/family_recipes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace coseg {

using Eigen::Vector2d;
using Eigen::Vector3d;

Eigen::Isometry3d frame_along(const Vector3d& origin, const Vector3d& axis) {
    Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
    const Vector3d z = axis.normalized();
    const Vector3d x = (std::abs(z[0]) < 0.9 ? Vector3d::UnitX() : Vector3d::UnitY());
    frame.linear().col(2) = z;
    frame.linear().col(0) = (x - z * z.dot(x)).normalized();
    frame.linear().col(1) = z.cross(frame.linear().col(0));
    frame.translation() = origin;
    return frame;
}

std::vector<ChainSphere> smooth_path(const std::vector<ChainSphere>& through, int pieces) {
    std::vector<ChainSphere> path;
    const int last = static_cast<int>(through.size()) - 1;
    for (int i = 0; i < last; ++i) {
        const ChainSphere& b = through[i];
        const ChainSphere& c = through[i + 1];
        const ChainSphere a = i > 0 ? through[i - 1] : ChainSphere(2.0 * b - c);
        const ChainSphere d = i + 1 < last ? through[i + 2] : ChainSphere(2.0 * c - b);
        for (int k = 0; k < pieces; ++k) {
            const double t = static_cast<double>(k) / pieces;
            ChainSphere s =
                b + 0.5 * t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a)));
            s[3] = b[3] + t * (c[3] - b[3]);
            path.push_back(s);
        }
    }
    path.push_back(through.back());
    return path;
}

std::vector<ChainSphere> mirrored(std::vector<ChainSphere> spheres) {
    for (ChainSphere& s : spheres) s[1] = -s[1];
    return spheres;
}

std::vector<Vector2d> rectangle(double half_x, double half_y) {
    return {{-half_x, -half_y}, {half_x, -half_y}, {half_x, half_y}, {-half_x, half_y}};
}

std::vector<Vector2d> ellipse(double half_x, double half_y, int corners) {
    std::vector<Vector2d> outline;
    for (int i = 0; i < corners; ++i) {
        const Vector2d d = direction(2.0 * std::numbers::pi * i / corners);
        outline.emplace_back(half_x * d[0], half_y * d[1]);
    }
    return outline;
}

Vector2d direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

}  // namespace coseg
