#pragma once
// Average geodesic distance: how far a face lies from the rest of the surface. Small on the trunk, large on
// tips.

#include <Eigen/Core>

#include "src/geodesics/geodesic.hpp"

namespace coseg {

/// One value per face: sum over samples k of weight_k * distance(k, face), minus the mesh's smallest such
/// sum. Unit: the mesh's length unit; the smallest value is 0. On a mesh of area 1 the unit is the square
/// root of the area, which is all the normalisation there is: shapes of equal form have equal values at any
/// original scale. Histograms rescale it once more, per mesh (rescale_per_mesh). Source: Kalogerakis,
/// Hertzmann, Singh 2010, after Hilaga et al. 2001. Deviates: the sum runs over samples with Voronoi areas
/// instead of over all faces, and Hilaga's division by the minimum is left out.
Eigen::VectorXd average_geodesic(const GeodesicTable& table);

}  // namespace coseg
