#pragma once
// Computes the smaller principal curvature, and the concavity that the minima rule derives from it.

#include <Eigen/Core>

#include "src/mesh/face_geometry.hpp"
#include "src/mesh/tri_mesh.hpp"

namespace coseg {

/// Principal curvatures in 1 / length. They are positive where the surface bends away from its normal (1 / r
/// on a sphere).
struct PrincipalCurvatures {
    Eigen::VectorXd minimum;  ///< V values, <= maximum
    Eigen::VectorXd maximum;  ///< V values
};

/// The eigenvalues, in the tangent plane, of the curvature tensor averaged over a vertex and its neighbours.
/// Each edge of two rings adds beta |e| e e^T, where beta is the signed turn between its faces and e its
/// direction; the sum is divided by the vertex areas. Boundary edges have no turn and count as flat. The
/// values are zero at vertices without faces. geometry = face_geometry(mesh).
///
/// Source: Cohen-Steiner and Morvan 2003, "Restricted Delaunay Triangulations and Normal Cycle", section 4.
///
/// Deviates: the averaging region is a number of rings, not a ball, so that it follows the resolution of the
/// mesh.
PrincipalCurvatures principal_curvatures(const TriMesh& mesh, const FaceGeometry& geometry);

/// The concavity of every VERTEX: clip(-kmin / s, 0, 1), where s is the 95th percentile of -kmin over all
/// vertices. It is 0 where the surface is nowhere concave, and 1 in its deepest creases. It is independent of
/// scale.
///
/// Source: the paper's minima rule (normalised minimum curvature at the vertices of a boundary).
///
/// Deviates: s is at least 1 / sqrt(total area), because on a shape that is convex all over, 95 % of -kmin
/// are noise about 0.
Eigen::VectorXd minimum_curvature(const TriMesh& mesh, const FaceGeometry& geometry);

}  // namespace coseg
