#pragma once
// Finds the rotation that brings points to the points they are linked with, although many links are wrong.

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace coseg {

/// Points of one shape and, for each, a point that it should come to. Units are those of patch_positions.
struct LinkedPoints {
    Eigen::Matrix3Xd own;
    Eigen::Matrix3Xd other;
    Eigen::VectorXd weight;  ///< >= 0, with sum 1; empty where nothing is linked
};

/// The distance at which a pair of linked patches agrees to exp(-1/2). About half of the distance between two
/// legs of a chair.
inline constexpr double agreement_width = 0.5;

/// The same links of the shape mirrored at its centre.
LinkedPoints mirrored(LinkedPoints points);

/// Mean over the links, by weight, of exp(-d^2 / 2 s^2) with d = |R own - other| and s = agreement_width.
double agreement(const LinkedPoints& points, const Eigen::Matrix3d& rotation);

/// The proper rotation R of largest trace(R^T moment), where moment is the sum of weight * other * own^T.
/// Source: Kabsch 1976.
Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& moment);

struct FittedRotation {
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
    double agreement = 0.0;
};

/// A local maximum of the agreement near `start`: steps of nearest_rotation, each with weights that fall with
/// the distance (iteratively reweighted least squares with Welsch's weights).
FittedRotation fitted_near(const LinkedPoints& points, const Eigen::Matrix3d& start);

/// The best of local maxima from all starts. The width of the weights begins large and shrinks; after the
/// first steps the best quarter of the starts goes on. At least one start.
FittedRotation fitted(const LinkedPoints& points, const std::vector<Eigen::Matrix3d>& starts);

/// Rotations that are spread uniformly, a hash of the seed.
std::vector<Eigen::Matrix3d> hashed_rotations(int count, std::uint64_t seed);

/// The 24 rotations that take the axes to axes, the identity first: what the customs of modelling programs
/// differ by.
std::vector<Eigen::Matrix3d> axis_rotations();

/// Those and 40 hashed ones: what is tried for a shape of which nothing is known.
std::vector<Eigen::Matrix3d> tried_rotations(std::uint64_t seed);

/// In degrees, 0 .. 180.
double angle_between(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b);

}  // namespace coseg
