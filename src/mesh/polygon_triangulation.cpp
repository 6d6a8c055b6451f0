#include "src/mesh/polygon_triangulation.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>

#include "src/base/index.hpp"

namespace coseg {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::Vector3i;

std::vector<Vector3i> fan(int corners) {
    std::vector<Vector3i> triangles;
    for (int k = 1; k + 1 < corners; ++k) triangles.emplace_back(0, k, k + 1);
    return triangles;
}

double turn(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
    return (b - a).x() * (c - b).y() - (b - a).y() * (c - b).x();
}

/// The polygon in the plane of its area vector, counter-clockwise.
std::vector<Vector2d> project(const std::vector<Vector3d>& corners, const Vector3d& area_vector) {
    Eigen::Index axis = 0;
    area_vector.cwiseAbs().maxCoeff(&axis);
    const auto u = (axis + 1) % 3;
    const auto v = (axis + 2) % 3;
    const double sign = area_vector[axis] < 0.0 ? -1.0 : 1.0;
    std::vector<Vector2d> flat;
    flat.reserve(corners.size());
    for (const Vector3d& p : corners) flat.emplace_back(p[u], sign * p[v]);
    return flat;
}

bool is_convex(const std::vector<Vector2d>& flat) {
    const int n = static_cast<int>(flat.size());
    for (int k = 0; k < n; ++k) {
        if (turn(flat[at(k)], flat[at((k + 1) % n)], flat[at((k + 2) % n)]) <= 0.0) return false;
    }
    return true;
}

std::vector<Vector3i> cut_quad(const std::vector<Vector3d>& p, const std::vector<Vector2d>& flat) {
    const bool first_inside = turn(flat[0], flat[1], flat[2]) > 0.0 && turn(flat[2], flat[3], flat[0]) > 0.0;
    const bool second_inside = turn(flat[1], flat[2], flat[3]) > 0.0 && turn(flat[3], flat[0], flat[1]) > 0.0;
    const bool first_shorter = (p[0] - p[2]).squaredNorm() <= (p[1] - p[3]).squaredNorm();
    const bool use_first = first_inside == second_inside ? first_shorter : first_inside;
    if (use_first) return {{0, 1, 2}, {0, 2, 3}};
    return {{1, 2, 3}, {1, 3, 0}};
}

bool contains(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& p) {
    return turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0;
}

class EarClipper {
  public:
    explicit EarClipper(const std::vector<Vector2d>& flat) : flat_(flat) {
        for (int k = 0; k < static_cast<int>(flat.size()); ++k) ring_.push_back(k);
    }

    std::vector<Vector3i> run() {
        std::vector<Vector3i> triangles;
        std::size_t start = 0;
        while (ring_.size() > 3) {
            const std::size_t ear = find_ear(start);
            triangles.emplace_back(before(ear), ring_[ear], after(ear));
            ring_.erase(ring_.begin() + static_cast<std::ptrdiff_t>(ear));
            start = ear;
        }
        triangles.emplace_back(ring_[0], ring_[1], ring_[2]);
        return triangles;
    }

  private:
    [[nodiscard]] int before(std::size_t k) const { return ring_[(k + ring_.size() - 1) % ring_.size()]; }
    [[nodiscard]] int after(std::size_t k) const { return ring_[(k + 1) % ring_.size()]; }

    [[nodiscard]] double turn_at(std::size_t k) const {
        return turn(flat_[at(before(k))], flat_[at(ring_[k])], flat_[at(after(k))]);
    }

    [[nodiscard]] bool is_ear(std::size_t k) const {
        if (turn_at(k) <= 0.0) return false;
        const Vector2d& a = flat_[at(before(k))];
        const Vector2d& b = flat_[at(ring_[k])];
        const Vector2d& c = flat_[at(after(k))];
        for (const int other : ring_) {
            const Vector2d& p = flat_[at(other)];
            if (p == a || p == b || p == c) continue;
            if (contains(a, b, c, p)) return false;
        }
        return true;
    }

    /// The first ear from `start` on; without one (a polygon that crosses itself) the sharpest convex corner.
    [[nodiscard]] std::size_t find_ear(std::size_t start) const {
        for (std::size_t step = 0; step < ring_.size(); ++step) {
            const std::size_t k = (start + step) % ring_.size();
            if (is_ear(k)) return k;
        }
        std::size_t best = start % ring_.size();
        for (std::size_t k = 0; k < ring_.size(); ++k) {
            if (turn_at(k) > turn_at(best)) best = k;
        }
        return best;
    }

    const std::vector<Vector2d>& flat_;
    std::vector<int> ring_;
};

}  // namespace

Vector3d polygon_area_vector(const std::vector<Vector3d>& corners) {
    Vector3d sum = Vector3d::Zero();
    for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
        sum += (corners[k] - corners[0]).cross(corners[k + 1] - corners[0]);
    }
    return 0.5 * sum;
}

std::vector<Vector3i> triangulate_polygon(const std::vector<Vector3d>& corners) {
    const int n = static_cast<int>(corners.size());
    if (n < 3) return {};
    if (n == 3) return {{0, 1, 2}};
    const std::vector<Vector2d> flat = project(corners, polygon_area_vector(corners));
    if (n == 4) return cut_quad(corners, flat);
    if (n > max_ear_clipping_corners || is_convex(flat)) return fan(n);
    return EarClipper(flat).run();
}

}  // namespace coseg
