#pragma once
// Computes the discrete Laplacian of a surface.

#include <Eigen/SparseCore>

#include "src/mesh/tri_mesh.hpp"

namespace coseg {

enum class LaplacianWeights {
    cotangent,  ///< each edge has half the sum of the cotangents opposite it
    uniform     ///< the weights of equilateral faces, whatever the shape of the faces
};

/// The matrix L, V x V, symmetric positive semidefinite: x^T L x is the Dirichlet energy of the function that
/// is linear on every face and has the values x at the vertices. It does not depend on unit and scale. Rows
/// sum to 0, and the row of a vertex that no face uses is empty. Borders are free (natural boundary
/// conditions).
///
/// Source: Pinkall and Polthier 1993.
///
/// Deviates: a face whose height is less than 1e-6 of its longest edge enters as an equilateral one, so that
/// weights stay finite and neighbours stay coupled.
Eigen::SparseMatrix<double> cotangent_laplacian(const TriMesh& mesh,
                                                LaplacianWeights weights = LaplacianWeights::cotangent);

}  // namespace coseg
