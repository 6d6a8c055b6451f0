#include "src/measures/oriented_box.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

#include "src/base/index.hpp"

namespace coseg {

namespace {

Eigen::Matrix3d principal_axes(const std::vector<Eigen::Vector3d>& points) {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& p : points) mean += p;
    mean /= static_cast<double>(points.size());
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const Eigen::Vector3d& p : points) spread += (p - mean) * (p - mean).transpose();
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors();
}

double cross(const Eigen::Vector2d& u, const Eigen::Vector2d& v) { return u.x() * v.y() - u.y() * v.x(); }

/// Counter-clockwise; fewer than three where all points lie on a line. Source: Andrew's monotone chain
/// (1979).
std::vector<Eigen::Vector2d> convex_hull(std::vector<Eigen::Vector2d> points) {
    const auto is_before = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
        return std::pair(a.x(), a.y()) < std::pair(b.x(), b.y());
    };
    std::sort(points.begin(), points.end(), is_before);
    points.erase(std::unique(points.begin(), points.end()), points.end());
    if (points.size() < 3) return points;
    std::vector<Eigen::Vector2d> hull;
    for (int half = 0; half < 2; ++half) {
        const std::size_t begin = hull.size();
        for (const Eigen::Vector2d& p : points) {
            while (hull.size() >= begin + 2 &&
                   cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0.0)
                hull.pop_back();
            hull.push_back(p);
        }
        hull.pop_back();  // the first one of the other half
        std::reverse(points.begin(), points.end());
    }
    return hull;
}

/// The extent of points along a direction: its lower end and its length.
struct Extent {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();
    void add(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
    [[nodiscard]] double length() const { return high - low; }
};

OrientedBox box_along(const std::vector<Eigen::Vector3d>& points, const Eigen::Matrix3d& axes) {
    std::array<Extent, 3> extents;
    for (const Eigen::Vector3d& p : points) {
        for (int k = 0; k < 3; ++k) extents[at(k)].add(axes.col(k).dot(p));
    }
    OrientedBox box;
    box.axes = axes;
    for (int k = 0; k < 3; ++k) {
        box.sizes[k] = extents[at(k)].length();
        box.center += 0.5 * (extents[at(k)].low + extents[at(k)].high) * axes.col(k);
    }
    return box;
}

/// The direction of the side of the smallest rectangle around the hull. One of its sides lies on an edge of
/// the hull (Freeman and Shapira 1975).
Eigen::Vector2d best_side(const std::vector<Eigen::Vector2d>& hull) {
    Eigen::Vector2d best = Eigen::Vector2d::UnitX();
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < hull.size(); ++k) {
        const Eigen::Vector2d side = (hull[(k + 1) % hull.size()] - hull[k]).normalized();
        Extent along;
        Extent across;
        for (const Eigen::Vector2d& p : hull) {
            along.add(side.dot(p));
            across.add(cross(side, p));
        }
        const double area = along.length() * across.length();
        if (area < least) {
            least = area;
            best = side;
        }
    }
    return best;
}

/// Axes with `normal` as the third, the others along the smallest rectangle around the points seen from
/// there.
Eigen::Matrix3d axes_across(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& normal) {
    const Eigen::Vector3d u = normal.unitOrthogonal();
    const Eigen::Vector3d v = normal.cross(u);
    std::vector<Eigen::Vector2d> seen;
    seen.reserve(points.size());
    for (const Eigen::Vector3d& p : points) seen.emplace_back(u.dot(p), v.dot(p));
    const Eigen::Vector2d side = best_side(convex_hull(std::move(seen)));
    Eigen::Matrix3d axes;
    axes.col(0) = side.x() * u + side.y() * v;
    axes.col(1) = normal.cross(axes.col(0));
    axes.col(2) = normal;
    return axes;
}

Eigen::Vector3d pointing_up(const Eigen::Vector3d& axis) {
    Eigen::Index largest = 0;
    axis.cwiseAbs().maxCoeff(&largest);
    return axis[largest] < 0.0 ? Eigen::Vector3d(-axis) : axis;
}

OrientedBox in_order(const OrientedBox& box) {
    std::array<int, 3> order{0, 1, 2};
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return box.sizes[a] > box.sizes[b]; });
    OrientedBox ordered = box;
    for (int k = 0; k < 3; ++k) {
        ordered.sizes[k] = box.sizes[order[at(k)]];
        ordered.axes.col(k) = pointing_up(box.axes.col(order[at(k)]));
    }
    ordered.axes.col(2) = ordered.axes.col(0).cross(ordered.axes.col(1));
    return ordered;
}

}  // namespace

OrientedBox oriented_box(const std::vector<Eigen::Vector3d>& points,
                         const std::vector<Eigen::Vector3d>& directions) {
    constexpr double gain_that_counts = 1e-9;
    OrientedBox best = box_along(points, Eigen::Matrix3d::Identity());
    const auto consider = [&](const Eigen::Vector3d& normal) {
        const OrientedBox box = box_along(points, axes_across(points, normal));
        if (box.sizes.prod() < (1.0 - gain_that_counts) * best.sizes.prod()) best = box;
    };
    for (int k = 0; k < 3; ++k) consider(Eigen::Vector3d::Unit(k));
    const Eigen::Matrix3d principal = principal_axes(points);
    for (int k = 0; k < 3; ++k) consider(principal.col(k));
    for (const Eigen::Vector3d& direction : directions) consider(direction.normalized());
    return in_order(best);
}

}  // namespace coseg
