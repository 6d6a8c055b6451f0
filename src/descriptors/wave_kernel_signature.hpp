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

/// The signature of every face, wave_kernel_energies x F, column major:
///     WKS(v, e) = C_e sum over k of phi_k(v)^2 exp(-(e - log lambda_k)^2 / (2 sigma^2))
/// The energies e divide the way from the lowest to the highest log lambda_k evenly, and sigma is 7 steps.
/// C_e is chosen so that the weights of the lambda_k sum to 1. A face has the mean of its three corners,
/// divided by the mean over the surface at that energy; then the logarithm is taken, and it is at least
/// log(1e-3). The values do not depend on unit and scale, nor on the signs of the phi_k. All are 0 with fewer
/// than two eigenpairs. `spectrum` is that of the mesh; geometry = face_geometry(mesh).
///
/// Source: Aubry, Schlickewei, Cremers 2011, "The wave kernel signature: a quantum mechanical approach to
/// shape analysis".
///
/// Deviates: the energies go from the first to the last eigenvalue, where theirs keep 2 sigma away. The
/// division by the mean of the mesh and the logarithm are ours; they let Euclidean distances compare meshes.
Eigen::MatrixXf wave_kernel_signature(const TriMesh& mesh, const FaceGeometry& geometry,
                                      const LaplacianSpectrum& spectrum);

/// One number for each of the columns of signatures: their mean over the lower half of the energies, high at
/// the tips of limbs.
Eigen::VectorXd wave_kernel_level(const Eigen::MatrixXf& signatures);

}  // namespace coseg
