#pragma once
// Solves row scope with a sparse W: a working set of pairs grows from violations of optimality.
//
// Source: working sets as in Celer (Massias, Gramfort, Salmon 2018) and ORGEN (You, Li, Robinson, Vidal
// 2016).

#include "solvers/subspace/solve_result.hpp"
#include "solvers/subspace/subspace_problem.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

/// Repeats until the certified gap is reached: solve on the working set, make one pass over all pairs, add
/// the worst violations, drop the pairs that stayed zero. Nothing of size N^2 is stored. Requires a valid
/// problem of row scope. Collective.
SolveResult solve_working_set(const Comm& comm, const SubspaceProblem& problem, const SolveOptions& options);

}  // namespace coseg
