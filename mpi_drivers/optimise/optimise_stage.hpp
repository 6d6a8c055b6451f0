#pragma once
// Finds coefficients from features: sets up the subspace problem as the options ask for it, solves it, and
// says how exactly.

#include <cstdint>
#include <string>
#include <vector>

#include "mpi_drivers/describe/feature_stage.hpp"
#include "mpi_drivers/describe/mesh_stage.hpp"
#include "mpi_drivers/options/stage_options.hpp"
#include "solvers/variants/subspace_solver.hpp"
#include "src/parallel/comm.hpp"
#include "src/parallel/stage_log.hpp"
#include "src/records/optimisation_facts.hpp"

namespace coseg {

struct Optimisation : OptimisationFacts {
    SolveResult result;
    std::vector<std::string> features;  ///< names of the coefficients' features: H of them, or one
};

/// The problem that the options ask for, without its features; the meshes' names are the seed of their links.
SubspaceProblem subspace_problem(const Collection& collection, const OptimiseOptions& options);
/// When its solver stops, and which it is.
SolveOptions solve_options(const OptimiseOptions& options);

/// For `checkpoint` see SolveOptions. `log` prints the progress and may be null. Collective. Throws
/// AgreedError: usage where --links or --variant do not fit the other options, and what solve_variant throws.
Optimisation optimise(const Comm& comm, const Collection& collection, const PatchFeatures& features,
                      const OptimiseOptions& options, SolverCheckpoint* checkpoint = nullptr,
                      StageLog* log = nullptr);

/// One line for the log.
std::string describe(const Optimisation& optimisation);

}  // namespace coseg
