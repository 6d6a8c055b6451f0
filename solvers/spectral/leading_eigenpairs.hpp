#pragma once
// The largest eigenvalues of a distributed symmetric matrix, by SLEPc.

#include <Eigen/Core>
#include <vector>

#include "solvers/spectral/row_product.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

struct EigenPairs {
    std::vector<double> values;
    std::vector<double> residuals;  ///< norms, as SLEPc estimates them; 0 where a pair is known
    Eigen::MatrixXd vectors;        ///< rows of this rank x values; columns orthonormal over all ranks

    void append(double value, double residual, const Eigen::VectorXd& vector);
};

/// Sorts by descending value; of equal values the earlier one stays first.
EigenPairs sorted_descending(const EigenPairs& pairs);

struct EigenRequest {
    int wanted = 1;            ///< >= 1
    double tolerance = 1e-10;  ///< of the residual norm
    int max_restarts = 2000;
};

/// The `wanted` largest eigenpairs orthogonal to the vectors of `known`, descending. `starts` holds one or
/// more vectors, rows of this rank; the Krylov-Schur method, which is taken unless the user's options choose
/// another one, takes the first of them. Vectors, basis and products are spread over the ranks by rows, and
/// all sums over rows are exact (exact_vectors). The small projected problem is solved by the first rank and
/// sent to the others. Every rank therefore goes the same way, with the same bits on any number of ranks.
/// Collective. Throws on all ranks: AgreedError(not_converged) with the residual reached, Error(internal).
EigenPairs leading_eigenpairs(const Comm& comm, const RowProduct& product, const EigenPairs& known,
                              const Eigen::MatrixXd& starts, const EigenRequest& request);

}  // namespace coseg
