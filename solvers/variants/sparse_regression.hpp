#pragma once
// The l1 form of subspace clustering: every column by a sparse combination of the others, each for itself.

#include "solvers/variants/subspace_solver.hpp"

namespace coseg {

enum class Sign { nonnegative, free };

/// min over W with zero diagonal of ||X W - X||_F^2 + beta ||W||_{1,1}, W >= 0 or of any sign, for a problem of
/// one feature; its other penalties are not used. The columns are independent: each rank solves its own and
/// nothing is communicated but the sums of the result. Coordinate descent on a working set per column, grown from
/// a pass over all pairs that also gives the lower bound: the residual's dual scaled, or for W >= 0 shifted,
/// until it is feasible. The relative gap is to the objective, as in row scope. Coefficients may be negative where the
/// sign is free. Requires a valid problem. Collective.
///
/// Source: the paper, equation (2), after Elhamifar and Vidal 2009; coordinate descent for the lasso
/// (Friedman, Hastie, Tibshirani 2010).
SolveResult solve_sparse_regression(const Comm& comm, const SubspaceProblem& problem, Sign sign,
                                    const SolveOptions& options);

}  // namespace coseg
