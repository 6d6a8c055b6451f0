#pragma once
// Computes the shape context: where the rest of the surface lies as seen from a face, by geodesic distance
// and by direction.

#include <Eigen/Core>
#include <array>

#include "src/geodesics/geodesic.hpp"

namespace coseg {

/// The inner edges between the radial bins, as fractions of the largest distance in the mesh's table.
inline constexpr std::array<double, 4> shape_context_radii{0.05, 0.1, 0.2, 0.4};
/// Equal bins of the angle over [0, pi].
inline constexpr int shape_context_angles = 6;
/// The number of bins against one kind of normal.
inline constexpr int shape_context_bins =
    (static_cast<int>(shape_context_radii.size()) + 1) * shape_context_angles;

/// The normal against which the angle is measured.
enum class ShapeContextNormal {
    /// The angle between c_k - c_i and -n_i: the direction in which face i sees sample k. This is the text of
    /// the paper.
    face,
    /// The angle between c_k - c_i and -n_k: whether k shows its inside or its outside to i. This is the code
    /// of the paper.
    sample,
    both,  ///< the bins of `face` above those of `sample`, each with half the weight
};

/// The contexts of all faces: shape_context_bins x F, or 2 shape_context_bins x F for `both`, column major.
/// Column i is the distribution of area over (distance, angle) around face i: each sample k of the table adds
/// its Voronoi weight to bin radial * shape_context_angles + angle. Columns sum to 1. They do not change when
/// the mesh is moved, turned or scaled. No column depends on the others except through the largest distance.
///
/// A sample exactly in the plane (angle pi / 2, the rule on flat parts) counts as below pi / 2: the edge
/// between the middle bins is moved by 1e-4 in the cosine, so that rounding does not scatter those samples
/// over two bins. A sample at the face's own centroid and normals of faces without area count there too.
///
/// Source: Kalogerakis, Hertzmann, Singh 2010.
///
/// Deviates: samples with Voronoi weights replace all faces, there is one binning of 5 x 6, the weight is by
/// area alone, and both normals are used: neither of the two is the better one for all kinds of shapes.
Eigen::MatrixXf shape_context(const GeodesicTable& table, const Eigen::Matrix3Xd& centroids,
                              const Eigen::Matrix3Xd& normals,
                              ShapeContextNormal normal = ShapeContextNormal::both);

/// One number for each of the columns of shape contexts: the mean ring of its area, 0 where all of the shape
/// is near, 4 where all of it is far.
Eigen::VectorXd shape_context_rings(const Eigen::MatrixXf& contexts);

}  // namespace coseg
