#pragma once
// The wave kernel signature: how likely a particle of a given energy is found at a place of the surface.
// Equal on parts of equal form, bent or not.

#include <Eigen/Core>

#include "src/descriptors/laplacian_spectrum.hpp"
#include "src/mesh/face_geometry.hpp"
#include "src/mesh/tri_mesh.hpp"

namespace coseg {

inline constexpr int wave_kernel_pairs = 100;     ///< eigenpairs
inline constexpr int wave_kernel_energies = 100;  ///< values a face

/// wave_kernel_energies x F, column major: the signature
///     WKS(v, e) = C_e sum over k of phi_k(v)^2 exp(-(e - log lambda_k)^2 / (2 sigma^2))
/// at energies e that divide the way from the lowest to the highest log lambda_k evenly, sigma = 7 steps, C_e so that the
/// weights of the lambda_k sum to 1; mean of the three corners; divided by its mean over the surface at that energy;
/// logarithm, at least log(1e-3). Free of unit and scale, and of the signs of the phi_k. All 0 with fewer than two eigenpairs.
/// spectrum: of the mesh; geometry = face_geometry(mesh).
/// Source: Aubry, Schlickewei, Cremers 2011, "The wave kernel signature: a quantum mechanical approach to shape analysis".
/// Deviates: energies from the first to the last eigenvalue, where theirs keep 2 sigma away; division by the mean of the mesh and
/// logarithm, so that Euclidean distances compare meshes.
Eigen::MatrixXf wave_kernel_signature(const TriMesh& mesh, const FaceGeometry& geometry,
                                      const LaplacianSpectrum& spectrum);

/// One number for each of the columns of signatures: their mean over the lower half of the energies, high at
/// the tips of limbs.
Eigen::VectorXd wave_kernel_level(const Eigen::MatrixXf& signatures);

}  // namespace coseg
