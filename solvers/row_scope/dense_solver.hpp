#pragma once
// The reference solver of row scope: every pair is stored, and the method is the spectral projected gradient
// as published.

#include "solvers/subspace/solve_result.hpp"
#include "solvers/subspace/subspace_problem.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

/// Stores 3 H N^2 doubles in all. Each trial step takes one reduction of the H N row sums, and each
/// certificate one maximum over as many numbers. Requires a valid problem of row scope. Collective.
SolveResult solve_dense(const Comm& comm, const SubspaceProblem& problem, const SolveOptions& options);

}  // namespace coseg
