#pragma once
// Lets a solver hand out what it has finished and take it back after a restart.

#include <cstdint>
#include <optional>
#include <tuple>
#include <vector>

#include "solvers/subspace/solve_history.hpp"
#include "solvers/subspace/spectral_projected_gradient.hpp"
#include "solvers/subspace/subspace_problem.hpp"
#include "src/parallel/block_range.hpp"
#include "src/records/fields.hpp"

namespace coseg {

struct SolveOptions;

/// The outcome of the columns [begin, end), which are one whole tile of the optimiser. It is a function of
/// the problem and the options, not of the rank that solved it.
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
    std::vector<ColumnRound> rounds;  ///< of all columns together, in terms of decrease
    static constexpr auto fields() {
        return std::tuple(field("begin", &SolvedTile::begin), field("end", &SolvedTile::end),
                          field("offsets", &SolvedTile::offsets), field("rows", &SolvedTile::rows),
                          field("values", &SolvedTile::values), field("decrease", &SolvedTile::decrease),
                          field("largest_decrease", &SolvedTile::largest_decrease),
                          field("residual", &SolvedTile::residual),
                          field("iterations", &SolvedTile::iterations), field("passes", &SolvedTile::passes),
                          field("working_pairs", &SolvedTile::working_pairs),
                          field("limited", &SolvedTile::limited), field("rounds", &SolvedTile::rounds));
    }
};

/// The state of the schedule of proximal points in the solve on the working set.
struct ProximalTurns {
    int next = 0;  ///< iteration of this solve
    double reach = 0.0;
    double largest_reach = 0.0;
    double sufficient_gap = 0.0;  ///< of the working set's problem, once proximal points are needed
    static constexpr auto fields() {
        return std::tuple(field("next", &ProximalTurns::next), field("reach", &ProximalTurns::reach),
                          field("largest_reach", &ProximalTurns::largest_reach),
                          field("sufficient_gap", &ProximalTurns::sufficient_gap));
    }
};

/// The state of row scope: in the middle of a solve on its working set, or at its end. It is a function of
/// the problem and the options. Each rank holds its own columns.
struct SolveIterate {
    BlockRange columns;
    std::vector<std::int64_t> offsets;  ///< columns.size() + 1, into rows
    std::vector<int> rows;              ///< the working set of each column
    std::vector<double> weights;        ///< H a pair
    std::vector<double> prices;         ///< H for each row whose number is in `columns`
    // The fields from here on are the same on all ranks.
    SpectralState spectral;
    double inner_gap = 0.0;    ///< asked of the working set's problem
    double lower_bound = 0.0;  ///< the best so far
    int iterations = 0;        ///< before this solve, or in all at the end
    int passes = 0;
    ProximalTurns proximal;
    SolveHistory history;
    // These fields are set at the end.
    bool finished = false;
    double objective = 0.0;
    double residual = 0.0;
    StopReason reason = StopReason::gap_reached;  ///< used where the gap is not reached
    static constexpr auto fields() {
        return std::tuple(
            field("columns", &SolveIterate::columns), field("offsets", &SolveIterate::offsets),
            field("rows", &SolveIterate::rows), field("weights", &SolveIterate::weights),
            field("prices", &SolveIterate::prices), field("spectral", &SolveIterate::spectral),
            field("inner_gap", &SolveIterate::inner_gap), field("lower_bound", &SolveIterate::lower_bound),
            field("iterations", &SolveIterate::iterations), field("passes", &SolveIterate::passes),
            field("proximal", &SolveIterate::proximal), field("history", &SolveIterate::history),
            field("finished", &SolveIterate::finished), field("objective", &SolveIterate::objective),
            field("residual", &SolveIterate::residual), field("reason", &SolveIterate::reason));
    }
};

/// What a solver should do with its iterate now.
enum class CheckpointAction { go_on, keep, keep_and_stop };

/// Receives finished tiles, or the iterate of a solver whose columns are not independent. A solver calls
/// open() once. Then it calls the members for tiles, for the columns that a rank owns and in ascending order,
/// or those for iterates. At last it calls close().
class SolverCheckpoint {
  public:
    SolverCheckpoint() = default;
    virtual ~SolverCheckpoint() = default;
    SolverCheckpoint(const SolverCheckpoint&) = delete;
    SolverCheckpoint& operator=(const SolverCheckpoint&) = delete;

    /// Says to which problem the tiles belong and which columns this rank will ask for. Collective. Throws
    /// AgreedError.
    virtual void open(const SubspaceProblem& problem, const SolveOptions& options, BlockRange owned) = 0;
    /// The tile that begins at this column, if it was finished before.
    virtual std::optional<SolvedTile> find(std::int64_t begin) = 0;
    virtual void keep(const SolvedTile& tile) = 0;
    /// True as soon as the solver should end early, because a rank has been asked to or a tile could not be
    /// kept.
    virtual bool should_stop() = 0;

    /// The iterate that was kept last, cut to the columns of open(). Collective.
    virtual std::optional<SolveIterate> find_iterate() = 0;
    /// Says what to do now; the answer is the same on all ranks. Collective.
    virtual CheckpointAction turn() = 0;
    /// Keeps the iterate in place of the one before. Collective. Throws AgreedError(output).
    virtual void keep_iterate(const SolveIterate& iterate) = 0;

    /// Call it after the last tile of every rank or the last iterate. Throws AgreedError if the solver ended
    /// early on any rank (`stopped`) or a tile could not be kept; returns if the solution is complete.
    /// Collective.
    virtual void close(bool stopped) = 0;
};

}  // namespace coseg
