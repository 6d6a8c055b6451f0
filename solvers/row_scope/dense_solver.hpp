#pragma once
// The reference: row scope with every pair stored, spectral projected gradient to the letter.

#include "solvers/subspace/solve_result.hpp"
#include "solvers/subspace/subspace_problem.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

/// Stores 3 H N^2 doubles in all; one reduction of the H N row sums per trial step, one maximum of as many
/// per certificate. Requires a valid problem of row scope. Collective.
SolveResult solve_dense(const Comm& comm, const SubspaceProblem& problem, const SolveOptions& options);

}  // namespace coseg
