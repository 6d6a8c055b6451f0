#pragma once
// Computes the average geodesic distance: how far a face lies from the rest of the surface. It is small on
// the trunk and large on tips.

#include <Eigen/Core>

#include "src/geodesics/geodesic.hpp"

namespace coseg {

/// One value for each face: the sum over samples k of weight_k * distance(k, face), minus the mesh's smallest
/// such sum. The unit is the mesh's length unit, and the smallest value is 0. On a mesh of area 1 the unit is
/// the square root of the area. There is no other normalisation: shapes of equal form have equal values at
/// any original scale. Histograms rescale the values once more for each mesh (rescale_per_mesh).
///
/// Source: Kalogerakis, Hertzmann, Singh 2010, after Hilaga et al. 2001.
///
/// Deviates: the sum runs over samples with Voronoi areas instead of over all faces, and Hilaga's division by
/// the minimum is left out.
Eigen::VectorXd average_geodesic(const GeodesicTable& table);

}  // namespace coseg
