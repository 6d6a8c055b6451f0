#pragma once
// Computes Gaussian curvature from the angles around a vertex.

#include <Eigen/Core>

#include "src/mesh/face_geometry.hpp"
#include "src/mesh/tri_mesh.hpp"

namespace coseg {

/// The angle defect of every vertex in radians: 2 pi minus the corner angles around it, or pi minus them on a
/// boundary, where it measures how the boundary turns. The sum is 2 pi times the Euler characteristic (Gauss
/// and Bonnet). It is zero for a vertex that no face uses. A face with two coincident corners counts as the
/// limit of a thin isosceles one.
Eigen::VectorXd angle_defects(const TriMesh& mesh);

/// A third of the area of the faces around every vertex; sums to the total area.
Eigen::VectorXd vertex_areas(const TriMesh& mesh, const FaceGeometry& geometry);

/// The mean of the values at its three corners, for every face.
Eigen::VectorXd mean_of_corners(const TriMesh& mesh, const Eigen::VectorXd& vertex_values);

/// Gaussian curvature, F values in 1 / length^2, which is independent of scale on a mesh of area 1. It is the
/// angle defect over the vertex area, and the mean of the three corners. It is positive on caps, negative on
/// saddles, and 0 on flat and cylindrical parts. It is unbounded: a corner of a box has its whole curvature
/// in one vertex. geometry = face_geometry(mesh).
///
/// Source: Meyer, Desbrun, Schroeder, Barr 2003, eq. (9).
///
/// Deviates: a third of the incident area replaces the mixed Voronoi area. It is never less than 1e-12 of the
/// total area, so that faces without area give finite values.
Eigen::VectorXd gaussian_curvature(const TriMesh& mesh, const FaceGeometry& geometry);

}  // namespace coseg
