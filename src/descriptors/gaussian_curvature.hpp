#pragma once
// Gaussian curvature from the angles around a vertex.

#include <Eigen/Core>

#include "src/mesh/face_geometry.hpp"
#include "src/mesh/tri_mesh.hpp"

namespace coseg {

/// Angle defect of every vertex, radians: 2 pi minus the corner angles around it, and pi minus them on a
/// boundary (there it measures how the boundary turns). Their sum is 2 pi times the Euler characteristic
/// (Gauss and Bonnet). Zero for a vertex that no face uses. A face with two coincident corners counts as the
/// limit of a thin isosceles one.
Eigen::VectorXd angle_defects(const TriMesh& mesh);

/// A third of the area of the faces around every vertex; sums to the total area.
Eigen::VectorXd vertex_areas(const TriMesh& mesh, const FaceGeometry& geometry);

/// Means of the three corners' values, one per face.
Eigen::VectorXd mean_of_corners(const TriMesh& mesh, const Eigen::VectorXd& vertex_values);

/// Gaussian curvature, F values, 1 / length^2 (free of scale on a mesh of area 1): angle defect over vertex
/// area, mean of the three corners. Positive on caps, negative on saddles, 0 on flat and cylindrical parts.
/// Unbounded: a corner of a box holds its whole curvature in one vertex. geometry = face_geometry(mesh).
/// Source: Meyer, Desbrun, Schroeder, Barr 2003, eq. (9).
/// Deviates: a third of the incident area in place of the mixed Voronoi area, and never less than 1e-12 of
/// the total area, so that faces without area give finite values.
Eigen::VectorXd gaussian_curvature(const TriMesh& mesh, const FaceGeometry& geometry);

}  // namespace coseg
