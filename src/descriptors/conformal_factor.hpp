#pragma once
// Computes how much a surface must be scaled, point by point, to spread its curvature evenly.

#include <Eigen/Core>

#include "src/mesh/face_geometry.hpp"
#include "src/mesh/tri_mesh.hpp"

namespace coseg {

/// The conformal factor phi, F values, independent of unit and scale: L phi = K_target - K at the vertices,
/// and the mean of the three corners for a face. L is the cotangent Laplacian (positive semidefinite), K the
/// angle defect, and K_target(v) = K_total (one-ring area of v) / (3 total area). Boundary conditions are
/// natural. Each component has its own K_total and its own area mean of 0. Sign: lengths are to be scaled by
/// exp(phi). phi is lowest (negative) at the tips of protruding limbs, which must shrink, and above 0 in the
/// body. geometry = face_geometry(mesh). Throws Error(internal) if the system cannot be solved.
///
/// Source: Ben-Chen and Gotsman 2008, "Characterizing Shape Using Conformal Factors", eqs. (1)-(3).
///
/// Deviates: a face whose height is less than 1e-6 of its longest edge enters L as an equilateral one, so
/// that weights stay finite and neighbours stay coupled. If the factorisation fails or leaves a relative
/// residual above 1e-6, all faces do (the uniform Laplacian, which has no degenerate case).
Eigen::VectorXd conformal_factor(const TriMesh& mesh, const FaceGeometry& geometry);

}  // namespace coseg
