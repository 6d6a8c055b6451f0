#pragma once
// How a solver hands out what it has finished and takes it back after a restart.

#include <cstdint>
#include <optional>
#include <vector>

#include "solvers/subspace/solve_history.hpp"
#include "solvers/subspace/spectral_projected_gradient.hpp"
#include "solvers/subspace/subspace_problem.hpp"
#include "src/parallel/block_range.hpp"

namespace coseg {

struct SolveOptions;

/// The outcome of the columns [begin, end), a whole tile of the optimiser: a function of the problem and the
/// options, not of the rank that solved it.
struct SolvedTile {
    std::int64_t begin = 0;
    std::int64_t end = 0;
    std::vector<std::int64_t> offsets;  ///< end - begin + 1, into rows; as in SparseCoefficients
    std::vector<int> rows;
    std::vector<double> values;            ///< H a row
    std::vector<double> decrease;          ///< per column
    std::vector<double> largest_decrease;  ///< per column
    double residual = 0.0;
    int iterations = 0;
    int passes = 0;
    std::int64_t working_pairs = 0;
    bool limited = false;             ///< a column stopped at the iteration limit
    std::vector<ColumnRound> rounds;  ///< of all columns together; reached: decrease
};

/// The proximal points that the solve on the working set still takes.
struct ProximalTurns {
    int next = 0;  ///< iteration of this solve
    double reach = 0.0;
    double largest_reach = 0.0;
    double sufficient_gap = 0.0;  ///< of the working set's problem, once proximal points are needed
};

/// Where row scope stands: in the middle of a solve on its working set, or at its end. A function of the
/// problem and the options; each rank holds its own columns.
struct SolveIterate {
    BlockRange columns;
    std::vector<std::int64_t> offsets;  ///< columns.size() + 1, into rows
    std::vector<int> rows;              ///< the working set of each column
    std::vector<double> weights;        ///< H a pair
    std::vector<double> prices;         ///< H for each row whose number is in `columns`
    // From here on the same on all ranks.
    SpectralState spectral;
    double inner_gap = 0.0;    ///< asked of the working set's problem
    double lower_bound = 0.0;  ///< the best so far
    int iterations = 0;        ///< before this solve; at the end: in all
    int passes = 0;
    ProximalTurns proximal;
    SolveHistory history;
    // At the end:
    bool finished = false;
    double objective = 0.0;
    double residual = 0.0;
    int reason = 0;  ///< StopReason, where the gap is not reached
};

/// What is to be done with an iterate now.
enum class CheckpointAction { go_on, keep, keep_and_stop };

/// Where finished tiles go, or the iterate of a solver whose columns are not independent. A solver calls
/// open() once, then for tiles the members in between for the columns that a rank owns, in ascending order,
/// or those for iterates, then close().
class SolverCheckpoint {
  public:
    SolverCheckpoint() = default;
    virtual ~SolverCheckpoint() = default;
    SolverCheckpoint(const SolverCheckpoint&) = delete;
    SolverCheckpoint& operator=(const SolverCheckpoint&) = delete;

    /// Collective: the problem that the tiles belong to, and the columns that this rank will ask for. Throws
    /// AgreedError.
    virtual void open(const SubspaceProblem& problem, const SolveOptions& options, BlockRange owned) = 0;
    /// The tile that begins at this column, if it was finished before.
    virtual std::optional<SolvedTile> find(std::int64_t begin) = 0;
    virtual void keep(const SolvedTile& tile) = 0;
    /// True as soon as the solver should end early: some rank has been asked to, or a tile could not be kept.
    virtual bool should_stop() = 0;

    /// The iterate that was kept last, cut to the columns of open(). Collective.
    virtual std::optional<SolveIterate> find_iterate() = 0;
    /// Alike on all ranks. Collective.
    virtual CheckpointAction turn() = 0;
    /// In place of the one before. Collective; throws AgreedError(output).
    virtual void keep_iterate(const SolveIterate& iterate) = 0;

    /// Collective, after the last tile of every rank or the last iterate. Throws AgreedError if the solver
    /// ended early on any rank (`stopped`) or a tile could not be kept; returns if the solution is complete.
    virtual void close(bool stopped) = 0;
};

}  // namespace coseg
