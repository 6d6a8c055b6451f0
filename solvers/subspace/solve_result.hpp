#pragma once
// The options of a solver of the subspace problem, and its result: the coefficients with the certificate of
// how close they are to the optimum.

#include <functional>

#include "solvers/subspace/coefficients.hpp"
#include "solvers/subspace/pair_scorer.hpp"
#include "solvers/subspace/solve_history.hpp"
#include "solvers/subspace/solver_checkpoint.hpp"
#include "src/base/enum_names.hpp"
#include "src/records/solve_summary.hpp"

namespace coseg {

/// How W is stored while it is solved for.
enum class SolverChoice {
    automatic,
    dense,        ///< all pairs; row scope only
    working_set,  ///< the pairs that may have a value
};
constexpr std::array<EnumName<SolverChoice>, 3> enum_names(SolverChoice /*type*/) {
    return {{{SolverChoice::automatic, "auto"},
             {SolverChoice::dense, "dense"},
             {SolverChoice::working_set, "working-set"}}};
}

/// What commands and the library accept.
inline constexpr double least_gap = 1e-14;
inline constexpr int most_solve_iterations = 1 << 30;
inline constexpr double most_solve_seconds = 1e9;

struct SolveOptions {
    double gap = 1e-4;            ///< the relative gap at which to stop; see SolveResult
    int max_iterations = 200000;  ///< of the inner method; mesh scope: per column
    double max_seconds = 3600.0;  ///< wall time
    SolverChoice solver = SolverChoice::automatic;
    /// Called while the solve is at work: in mesh scope after every tile, with the number of this rank's
    /// columns, solved and in all; in row scope now and then, with 0 of 1. May be empty.
    std::function<void(std::int64_t, std::int64_t)> progress = {};
    SolverCheckpoint* checkpoint = nullptr;  ///< keeps finished tiles or the iterate; none by default
    PairScorerFactory pair_scorer = processor_pair_scorer;  ///< computes the scores of the passes over pairs
};

/// The cost of this rank's passes over all pairs.
struct PassCost {
    double cpu_seconds = 0.0;
    double wall_seconds = 0.0;           ///< the following included
    double communication_seconds = 0.0;  ///< in collective calls, with the time of waiting
    double waiting_cpu_seconds = 0.0;    ///< in collective calls; a part of cpu_seconds
};

struct SolveResult : SolveSummary {
    SparseCoefficients coefficients;
    PassCost pass_cost;  ///< of the working-set solver and of mesh scope; differs between ranks
};

}  // namespace coseg
