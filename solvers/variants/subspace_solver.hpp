#pragma once
// One interface to all solvers of the subspace problem, with a certificate of how close the answer is.

#include "solvers/subspace/solve_result.hpp"
#include "solvers/subspace/subspace_problem.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

/// Solves the problem to `options.gap`. The problem must be the same on every rank. The answer has the same
/// bits on any number of ranks unless a time limit ends it early. Throws AgreedError(input) for what
/// validate() refuses and AgreedError(usage) for an unknown solver. A limit that is reached is no error here:
/// see `reason`. Collective.
SolveResult solve_subspace(const Comm& comm, const SubspaceProblem& problem, const SolveOptions& options);

}  // namespace coseg
