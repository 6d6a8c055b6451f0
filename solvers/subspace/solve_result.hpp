#pragma once
// The options of a solver of the subspace problem, and its result: the coefficients with the certificate of
// how close they are to the optimum.

#include <functional>
#include <string>

#include "solvers/subspace/coefficients.hpp"
#include "solvers/subspace/solve_history.hpp"
#include "solvers/subspace/solver_checkpoint.hpp"

namespace coseg {

struct SolveOptions {
    double gap = 1e-4;            ///< the relative gap at which to stop; see SolveResult
    int max_iterations = 200000;  ///< of the inner method; mesh scope: per column
    double max_seconds = 3600.0;  ///< wall time
    std::string solver = "auto";  ///< "auto", "dense" (row scope only) or "working-set"
    /// Mesh scope: called after every tile with the number of this rank's columns, solved and in all. May be
    /// empty.
    std::function<void(std::int64_t, std::int64_t)> progress = {};
    SolverCheckpoint* checkpoint = nullptr;  ///< keeps finished tiles or the iterate; none by default
};

/// From best to worst.
enum class StopReason { gap_reached, residual_reached, iteration_limit, time_limit };

/// The cost of this rank's passes over all pairs.
struct PassCost {
    double cpu_seconds = 0.0;
    double wall_seconds = 0.0;           ///< the following included
    double communication_seconds = 0.0;  ///< in collective calls, with the time of waiting
    double waiting_cpu_seconds = 0.0;    ///< in collective calls; a part of cpu_seconds
};

struct SolveResult {
    SparseCoefficients coefficients;
    double objective = 0.0;          ///< at the coefficients; an upper bound of the optimum
    double objective_at_zero = 0.0;  ///< sum_h ||X_h||_F^2
    double lower_bound = 0.0;        ///< of the optimum; rounding is allowed for
    /// (objective - lower_bound) / objective in row scope; in mesh scope the divisor is objective_at_zero -
    /// objective. 0 where both bounds agree to the last bits.
    double relative_gap = 0.0;
    double kkt_residual = 0.0;        ///< norm of (W - prox(W - t G)) / t, relative to the size of G at W = 0
    int iterations = 0;               ///< in mesh scope, of the column that took most
    int passes = 0;                   ///< over all pairs
    std::int64_t working_pairs = 0;   ///< pairs that the last working set held, all ranks
    std::int64_t nonzero_groups = 0;  ///< pairs with a value > 0, all ranks
    StopReason reason = StopReason::gap_reached;
    /// One row for each pass over all pairs (dense solver: for each certificate); the last row has the
    /// figures above. In mesh scope and for ssc, row k is the state after every column's k-th pass. The
    /// history is complete also where a checkpoint resumes the solve.
    SolveHistory history;
    PassCost pass_cost;  ///< of the working-set solver and of mesh scope; differs between ranks
};

/// "gap_reached", "residual_reached", "iteration_limit" or "time_limit".
std::string to_string(StopReason reason);

}  // namespace coseg
