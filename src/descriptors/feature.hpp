#pragma once
// The list of the descriptors of a face, each of which gives one feature of a patch.

#include <array>

namespace coseg {

/// The scalar descriptors in the order in which the features are numbered; shape contexts become feature 3.
enum class Feature : int {
    gaussian_curvature,
    shape_diameter,
    average_geodesic,
    shape_context,
    conformal_factor
};
inline constexpr int feature_total = 5;
inline constexpr std::array<const char*, feature_total> feature_names = {
    "gaussian_curvature", "shape_diameter", "average_geodesic", "shape_context", "conformal_factor"};

}  // namespace coseg
