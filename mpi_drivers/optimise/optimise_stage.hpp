#pragma once
// From features to coefficients: sets up the subspace problem as the options ask for it, solves it, and says how well.

#include <cstdint>
#include <string>
#include <vector>

#include "mpi_drivers/describe/feature_stage.hpp"
#include "mpi_drivers/describe/mesh_stage.hpp"
#include "mpi_drivers/options/run_options.hpp"
#include "solvers/variants/subspace_solver.hpp"
#include "src/parallel/comm.hpp"
#include "src/parallel/stage_log.hpp"

namespace coseg {

struct Optimisation {
    SolveResult result;
    std::string variant;
    std::string scope;  ///< what it came to: one mesh alone is always of row scope, ssc and ssqp too
    int links = 0;      ///< meshes in which a patch may have matches, at most
    std::vector<std::string> features;  ///< names of the coefficients' features: H of them, or one
    int subsets = 1;                    ///< in which the collection was solved, see subset_stage.hpp
    int common_meshes = 0;              ///< meshes in every subset, if there are several
    double subset_agreement =
        1.0;  ///< mean share of the common meshes' area on which a subset agrees with the first
    std::int64_t allowed_pairs = 0;  ///< that the certificate covers
};

/// checkpoint: see SolveOptions; log: is told of the progress, and may be null. Collective. Throws AgreedError: usage where --links or --variant do not fit the rest, what
/// solve_variant throws.
Optimisation optimise(const Comm& comm, const Collection& collection, const PatchFeatures& features,
                      const RunOptions& options, SolverCheckpoint* checkpoint = nullptr,
                      StageLog* log = nullptr);

/// One line for the log.
std::string describe(const Optimisation& optimisation);

}  // namespace coseg
