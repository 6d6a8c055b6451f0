#include "solvers/alignment/rotation_fit.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "src/base/index.hpp"
#include "src/base/seeded_random.hpp"

namespace coseg {

namespace {

constexpr double coarse_widths[] = {1.2, 1.0, 0.8, 0.65};
constexpr int fine_steps = 6;
constexpr int near_steps = 5;

/// Of every link: weight * exp(-d^2 / 2 width^2), with d as in agreement().
Eigen::VectorXd falling_weights(const LinkedPoints& points, const Eigen::Matrix3d& rotation, double width) {
    const double factor = -0.5 / (width * width);
    const Eigen::Matrix3Xd difference = rotation * points.own - points.other;
    return points.weight.array() * (factor * difference.colwise().squaredNorm().transpose().array()).exp();
}

/// The moment of nearest_rotation with these weights.
Eigen::Matrix3d weighed_moment(const LinkedPoints& points, const Eigen::Matrix3d& rotation, double width) {
    const Eigen::VectorXd weights = falling_weights(points, rotation, width);
    return (points.other * weights.asDiagonal()).lazyProduct(points.own.transpose());
}

Eigen::Matrix3d stepped(const LinkedPoints& points, Eigen::Matrix3d rotation, double width, int steps) {
    for (int k = 0; k < steps; ++k) rotation = nearest_rotation(weighed_moment(points, rotation, width));
    return rotation;
}

FittedRotation measured(const LinkedPoints& points, const Eigen::Matrix3d& rotation) {
    return {rotation, agreement(points, rotation)};
}

}  // namespace

LinkedPoints mirrored(LinkedPoints points) {
    points.own = -points.own;
    return points;
}

double agreement(const LinkedPoints& points, const Eigen::Matrix3d& rotation) {
    return falling_weights(points, rotation, agreement_width).sum();
}

Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& moment) {
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(moment, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Eigen::Matrix3d u = svd.matrixU();
    if ((u * svd.matrixV().transpose()).determinant() < 0.0) u.col(2) = -u.col(2);
    return u * svd.matrixV().transpose();
}

FittedRotation fitted_near(const LinkedPoints& points, const Eigen::Matrix3d& start) {
    return measured(points, stepped(points, start, agreement_width, near_steps));
}

FittedRotation fitted(const LinkedPoints& points, const std::vector<Eigen::Matrix3d>& starts) {
    std::vector<FittedRotation> candidates;
    for (Eigen::Matrix3d rotation : starts) {
        for (const double width : coarse_widths) rotation = stepped(points, rotation, width, 1);
        candidates.push_back(measured(points, rotation));
    }
    const auto better = [](const FittedRotation& a, const FittedRotation& b) {
        return a.agreement > b.agreement;
    };
    std::stable_sort(candidates.begin(), candidates.end(), better);
    candidates.resize((candidates.size() + 3) / 4);
    for (FittedRotation& candidate : candidates)
        candidate = measured(points, stepped(points, candidate.rotation, agreement_width, fine_steps));
    return *std::min_element(candidates.begin(), candidates.end(), better);
}

std::vector<Eigen::Matrix3d> hashed_rotations(int count, std::uint64_t seed) {
    std::vector<Eigen::Matrix3d> rotations;
    for (int k = 0; k < count; ++k) {
        Eigen::Vector4d q;  // four normal numbers: uniform over the sphere of unit quaternions
        for (int a = 0; a < 4; ++a)
            q[a] =
                normal_of(hash_words({seed, static_cast<std::uint64_t>(k), static_cast<std::uint64_t>(a)}));
        rotations.push_back(Eigen::Quaterniond(q.normalized()).toRotationMatrix());
    }
    return rotations;
}

std::vector<Eigen::Matrix3d> axis_rotations() {
    std::vector<Eigen::Matrix3d> rotations;
    for (int x = 0; x < 3; ++x) {
        for (int y = 0; y < 3; ++y) {
            if (y == x) continue;
            for (const double sx : {1.0, -1.0}) {
                for (const double sy : {1.0, -1.0}) {
                    Eigen::Matrix3d rotation;
                    rotation.col(0) = sx * Eigen::Vector3d::Unit(x);
                    rotation.col(1) = sy * Eigen::Vector3d::Unit(y);
                    rotation.col(2) = rotation.col(0).cross(rotation.col(1));
                    rotations.push_back(rotation);
                }
            }
        }
    }
    return rotations;
}

std::vector<Eigen::Matrix3d> tried_rotations(std::uint64_t seed) {
    constexpr int hashed = 40;
    std::vector<Eigen::Matrix3d> rotations = axis_rotations();
    for (const Eigen::Matrix3d& rotation : hashed_rotations(hashed, seed)) rotations.push_back(rotation);
    return rotations;
}

double angle_between(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
    const double cosine = 0.5 * ((a.transpose() * b).trace() - 1.0);
    return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / std::numbers::pi;
}

}  // namespace coseg
