#pragma once
// The smaller principal curvature, and the concavity that the minima rule reads from it.

#include <Eigen/Core>

#include "src/mesh/face_geometry.hpp"
#include "src/mesh/tri_mesh.hpp"

namespace coseg {

/// Principal curvatures, 1 / length; positive where the surface bends away from its normal (1 / r on a
/// sphere).
struct PrincipalCurvatures {
    Eigen::VectorXd minimum;  ///< V values, <= maximum
    Eigen::VectorXd maximum;  ///< V values
};

/// Eigenvalues, in the tangent plane, of the curvature tensor averaged over a vertex and its neighbours: the
/// edges of two rings, each beta |e| e e^T (beta the signed turn between its faces, e its direction), over
/// the vertex areas. Boundary edges have no turn and count as flat. Zero at vertices without faces. geometry
/// = face_geometry(mesh). Source: Cohen-Steiner and Morvan 2003, "Restricted Delaunay Triangulations and
/// Normal Cycle", section 4. Deviates: the averaging region is a number of rings, not a ball, so that it
/// follows the resolution of the mesh.
PrincipalCurvatures principal_curvatures(const TriMesh& mesh, const FaceGeometry& geometry);

/// Concavity per VERTEX: clip(-kmin / s, 0, 1) with s the 95th percentile of -kmin over all vertices: 0 where
/// the surface is nowhere concave, 1 in its deepest creases. Free of scale. Source: the paper's minima rule
/// (normalised minimum curvature at the vertices of a boundary). Deviates: s is at least 1 / sqrt(total
/// area); on a shape that is convex all over, 95 % of -kmin are noise about 0.
Eigen::VectorXd minimum_curvature(const TriMesh& mesh, const FaceGeometry& geometry);

}  // namespace coseg
