#pragma once
// Solves mesh scope: every patch finds matches in every other mesh, and each column is certified, without
// communication.
//
// Source: docs/method.md, section 5. The working set of each column follows Celer (Massias, Gramfort,
// Salmon 2018): solve on a few pairs, make one pass over all pairs, add those that violate optimality.

#include "solvers/subspace/solve_result.hpp"
#include "solvers/subspace/subspace_problem.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

/// Each column is solved until its own gap, relative to its own decrease from W = 0, is at most options.gap.
/// This bounds the gap of the whole in the same way. Ranks communicate for the final sums only. Requires a
/// valid problem of mesh scope. Collective.
SolveResult solve_mesh_scope(const Comm& comm, const SubspaceProblem& problem, const SolveOptions& options);

}  // namespace coseg
