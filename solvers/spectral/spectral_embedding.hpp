#pragma once
// Computes the leading eigenvectors of a normalised affinity. Its normalised cuts are found in their
// coordinates.

#include <Eigen/Core>
#include <vector>

#include "solvers/affinity/sparse_rows.hpp"
#include "solvers/spectral/vector_sums.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

struct SpectralOptions {
    /// 0.5 as in the paper's code: S + offset I, degrees + 2 offset; the scale of S then matters.
    double offset = 0.0;
    double tolerance = 1e-10;   ///< residual norm of an eigenpair (the operator has norm 1)
    int max_restarts = 2000;    ///< of the Krylov-Schur method
    double mesh_balance = 0.0;  ///< tau in [0, 1]; not with an offset
    VectorSums sums = VectorSums::exact;
};

/// Coordinates of the patches that take part in the cut.
struct SpectralEmbedding {
    std::vector<int> rows;            ///< ascending; the others are set aside, see main_components
    std::vector<double> eigenvalues;  ///< descending, in [-1 - tau, 1]
    std::vector<double> residuals;    ///< norms of the eigenpairs' residuals as estimated; 0 where known
    std::vector<double> degrees;      ///< per row of `rows`, > 0
    Eigen::MatrixXd coordinates;      ///< rows x eigenvalues; each column of norm sqrt(rows)
};

/// Up to this number of patches the eigenproblem is solved densely, on every rank in the same way.
inline constexpr int dense_rows = 128;

/// The `count` largest eigenvectors of D^-1/2 S D^-1/2, multiplied by D^-1/2, for a cut into
/// `parts` <= count; fewer where fewer rows take part. `affinity` is symmetric with entries >= 0; whoever
/// moves it here does not hold it beside the operator made of it.
///
/// The eigenvectors of eigenvalue 1 are known, one for each component, and are deflated instead of
/// computed. The others come from SLEPc's Krylov-Schur method with a seeded start. Further solves on the
/// complement of what was found then look for more copies of multiple eigenvalues, which a single Krylov
/// space does not contain.
///
/// mesh_balance tau makes it costly to cut whole meshes apart. From the operator tau Q Q^T is subtracted
/// on the complement of the eigenvectors of eigenvalue 1, where Q holds the indicators D^1/2 1_m of the
/// meshes, scaled to unit length. A vector that is constant on each mesh thus loses tau, and one whose mean
/// over each mesh is 0 loses nothing. `mesh_of` is the mesh 0 .. M-1 of each patch; it may be empty where tau
/// is 0.
///
/// Rows of the affinity, eigenvectors, basis and products are spread over the ranks of `comm`
/// (leading_eigenpairs); at the end every rank has the coordinates. The result is a function of the affinity
/// alone and has the same bytes on
/// any number of ranks. Collective. Throws on all ranks: AgreedError(not_converged) with the residual
/// reached, AgreedError(input) where no two patches have an affinity or fewer than `parts` patches take part.
///
/// Source: Shi and Malik 2000; the code of Cour, Yu and Shi, which the paper used.
///
/// Deviates: rows are set aside (main_components), and mesh_balance.
SpectralEmbedding spectral_embedding(const Comm& comm, SparseRows affinity, int parts, int count,
                                     const SpectralOptions& options, const std::vector<int>& mesh_of = {});

}  // namespace coseg
