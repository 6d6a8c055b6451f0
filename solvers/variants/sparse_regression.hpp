#pragma once
// The l1 form of subspace clustering: every column is written by itself as a sparse combination of the
// others.

#include "solvers/variants/subspace_solver.hpp"

namespace coseg {

enum class Sign { nonnegative, free };

/// Finds the minimum over W with zero diagonal of ||X W - X||_F^2 + beta ||W||_{1,1}, with W >= 0 or of any
/// sign, for a problem of one feature; its other penalties are not used. The columns are independent: each
/// rank solves its own, and only the sums of the result are communicated. Each column is solved by coordinate
/// descent on a working set, which grows from passes over all pairs. A pass also gives the lower bound: the
/// dual of the residual is scaled, or for W >= 0 shifted, until it is feasible. The gap is relative to the
/// objective, as in row scope. Coefficients may be negative where the sign is free. Requires a valid problem.
/// Collective.
///
/// Source: the paper, equation (2), after Elhamifar and Vidal 2009; coordinate descent for the lasso
/// (Friedman, Hastie, Tibshirani 2010).
SolveResult solve_sparse_regression(const Comm& comm, const SubspaceProblem& problem, Sign sign,
                                    const SolveOptions& options);

}  // namespace coseg
