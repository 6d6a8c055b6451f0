#pragma once
// Mesh scope: one match in every other mesh, certified column by column, without communication.
//
// Source: facts of the method in docs/method.md ("mesh scope"); the working set of each column follows Celer
//   (Massias, Gramfort, Salmon 2018): solve on a few pairs, look at all pairs once, add what violates
//   optimality.

#include "solvers/subspace/solve_result.hpp"
#include "solvers/subspace/subspace_problem.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

/// Each column is solved until its own gap, relative to its own decrease from W = 0, is at most options.gap,
/// which bounds the whole gap likewise. Ranks communicate for the final sums only. Requires a valid problem
/// of mesh scope. Collective.
SolveResult solve_mesh_scope(const Comm& comm, const SubspaceProblem& problem, const SolveOptions& options);

}  // namespace coseg
