#include "solvers/mesh_scope/mesh_scope_solver.hpp"

#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <span>

#include "solvers/mesh_scope/mesh_scope_column.hpp"
#include "solvers/mesh_scope/mesh_scope_pass.hpp"
#include "src/base/index.hpp"
#include "src/base/stopwatch.hpp"
#include "src/parallel/exact_sum.hpp"

namespace coseg {

namespace {

/// Decreases below this share of ||x_j||^2 are rounding.
constexpr double negligible = 1e-15;

enum class ColumnState { open, gap_reached, rounding_reached, limit_reached };

/// The state of a column that is being solved: its working set, its point and both ends of its gap.
struct Column {
    WorkingColumn working;
    std::vector<int> groups;             ///< group of each run of working.group_begin
    std::vector<double> reconstruction;  ///< X w
    std::vector<double> group_sums;      ///< per group of rows
    double decrease = 0.0;               ///< objective at 0 minus objective
    double largest_decrease = 0.0;       ///< no W reaches more
    double squared_norm = 0.0;
    double residual = 0.0;
    double inner_gap = 0.0;  ///< asked of the working set's problem, relative to its decrease
    int iterations = 0;
    std::vector<ColumnRound> rounds;
    ColumnState state = ColumnState::open;
};

struct Totals {
    int iterations = 0;
    int passes = 0;
    std::int64_t working_pairs = 0;
    bool limited = false;
    double residual = 0.0;
    std::vector<std::vector<ColumnRound>> rounds;  ///< per tile
};

class MeshScopeSolver {
  public:
    MeshScopeSolver(const Comm& comm, const SubspaceProblem& problem, const SolveOptions& options)
        : options_(options),
          penalties_{problem.alpha, problem.beta, problem.lambda},
          meshes_(sort_by_mesh(problem.mesh_of)),
          stack_(stack_features(comm, problem, meshes_.order)),
          pass_(comm, stack_, meshes_, penalties_, options.pair_scorer),
          allowed_meshes_(problem.allowed_meshes) {}

    /// The columns [begin, end) of the problem, each solved; a function of these columns alone.
    SolvedTile solve_tile(std::int64_t begin, std::int64_t end);

    /// The time limit has ended a tile early. Which tile was the last one to be solved depends on the
    /// machine.
    [[nodiscard]] bool timed_out() const noexcept { return timed_out_; }
    [[nodiscard]] const FeatureStack& stack() const noexcept { return stack_; }
    [[nodiscard]] int patch(int place) const { return meshes_.order[at(place)]; }

  private:
    [[nodiscard]] Column start_column(std::int64_t patch) const;
    [[nodiscard]] std::vector<int> allowed_groups(int mesh) const;
    [[nodiscard]] bool out_of_time() const { return clock_.seconds() >= options_.max_seconds; }
    int solve_batch(std::span<Column*> batch, const std::vector<int>& allowed);
    void judge(Column& column, const ColumnVerdict& verdict) const;
    bool add_violators(Column& column, const ColumnVerdict& verdict) const;
    void solve_working_set(Column& column);
    void append_column(const Column& column, SolvedTile& tile) const;

    const SolveOptions& options_;
    ColumnPenalties penalties_;
    MeshOrder meshes_;
    FeatureStack stack_;
    MeshScopePass pass_;
    const std::vector<std::vector<int>>& allowed_meshes_;
    Stopwatch clock_;
    bool timed_out_ = false;
};

Column MeshScopeSolver::start_column(std::int64_t patch) const {
    Column column;
    column.working.column = meshes_.place[at(patch)];
    column.working.group_begin = {0};
    column.reconstruction.assign(at(stack_.dimension), 0.0);
    column.group_sums.assign(meshes_.group_mesh.size(), 0.0);
    for (int k = 0; k < stack_.dimension; ++k) {
        const double x = stack_.columns(k, column.working.column);
        column.squared_norm += x * x;
    }
    column.largest_decrease = column.squared_norm;
    column.inner_gap = 0.3 * options_.gap;
    return column;
}

std::vector<int> MeshScopeSolver::allowed_groups(int mesh) const {
    std::vector<int> groups;
    for (std::size_t g = 0; g < meshes_.group_mesh.size(); ++g) {
        const int other = meshes_.group_mesh[g];
        const bool all = allowed_meshes_.empty();
        if (all || (other != mesh && std::ranges::binary_search(allowed_meshes_[at(mesh)], other))) {
            groups.push_back(static_cast<int>(g));
        }
    }
    return groups;
}

SolvedTile MeshScopeSolver::solve_tile(std::int64_t begin, std::int64_t end) {
    std::vector<Column> columns;
    for (std::int64_t j = begin; j < end; ++j) columns.push_back(start_column(j));
    const auto mesh_of = [&](const Column* column) {
        const int group = meshes_.group_of[at(column->working.column)];
        return meshes_.group_mesh[at(group)];
    };
    std::vector<Column*> order;
    for (Column& column : columns) order.push_back(&column);
    // Columns of one mesh see the same rows; where all rows are allowed, those of all meshes do.
    const bool together = allowed_meshes_.empty();
    std::stable_sort(order.begin(), order.end(),
                     [&](const Column* a, const Column* b) { return mesh_of(a) < mesh_of(b); });
    int passes = 0;
    for (std::size_t first = 0; first < order.size();) {
        std::size_t last = first + 1;
        while (last < order.size() && (together || mesh_of(order[last]) == mesh_of(order[first]))) ++last;
        passes = std::max(passes, solve_batch(std::span(order).subspan(first, last - first),
                                              allowed_groups(mesh_of(order[first]))));
        first = last;
    }
    SolvedTile tile;
    tile.begin = begin;
    tile.end = end;
    tile.offsets = {0};
    tile.passes = passes;
    std::vector<std::vector<ColumnRound>> rounds;
    for (const Column& column : columns) {
        tile.iterations = std::max(tile.iterations, column.iterations);
        tile.working_pairs += static_cast<std::int64_t>(column.working.rows.size());
        tile.residual = std::max(tile.residual, column.residual);
        tile.limited = tile.limited || column.state == ColumnState::limit_reached;
        tile.decrease.push_back(column.decrease);
        tile.largest_decrease.push_back(column.largest_decrease);
        append_column(column, tile);
        rounds.push_back(column.rounds);
    }
    tile.rounds = joined_rounds(rounds);
    return tile;
}

/// Repeats pass, addition of pairs and solve until every column has its gap. Returns the number of passes.
int MeshScopeSolver::solve_batch(std::span<Column*> batch, const std::vector<int>& allowed) {
    int passes = 0;
    std::vector<Column*> open(batch.begin(), batch.end());
    bool exact = false;  // single precision has nothing to add any more: the next pass is in double
    while (!open.empty()) {
        std::vector<PassColumn> seen;
        for (const Column* column : open) {
            seen.push_back({&column->working, column->reconstruction.data(), column->group_sums});
        }
        const std::vector<ColumnVerdict> verdicts =
            exact ? pass_.double_precision(seen, allowed) : pass_.single_precision(seen, allowed);
        ++passes;
        bool any_added = false;
        for (std::size_t c = 0; c < open.size(); ++c) {
            Column& column = *open[c];
            judge(column, verdicts[c]);
            if (column.state != ColumnState::open) continue;
            const bool added = add_violators(column, verdicts[c]);
            any_added = any_added || added;
            if (!added && exact) {
                column.inner_gap *= 0.1;
                if (column.inner_gap < negligible) column.state = ColumnState::rounding_reached;
            }
            if (added || exact) solve_working_set(column);
        }
        exact = !any_added;
        if (out_of_time()) {
            timed_out_ = true;
            for (Column* column : open) {
                if (column->state == ColumnState::open) column->state = ColumnState::limit_reached;
            }
        }
        std::erase_if(open, [](const Column* column) { return column->state != ColumnState::open; });
    }
    return passes;
}

void MeshScopeSolver::judge(Column& column, const ColumnVerdict& verdict) const {
    column.largest_decrease = std::min(column.largest_decrease, verdict.largest_decrease);
    append_round(column.rounds, {column.decrease, column.largest_decrease, column.iterations,
                                 static_cast<std::int64_t>(column.working.rows.size())});
    const double gap = column.largest_decrease - column.decrease;
    if (gap <= std::max(options_.gap * column.decrease, negligible * column.squared_norm)) {
        column.state = ColumnState::gap_reached;
    }
}

/// Adds the leaders that optimality does not allow to stay at zero; false if there are none.
bool MeshScopeSolver::add_violators(Column& column, const ColumnVerdict& verdict) const {
    std::vector<int> rows;
    for (std::size_t g = 0; g < verdict.leaders.size(); ++g) {
        const double limit = penalties_.alpha + 2.0 * penalties_.lambda * column.group_sums[g];
        for (int l = 0; l < 2; ++l) {
            if (verdict.leaders[g].row[l] >= 0 && verdict.leaders[g].norm[l] > limit)
                rows.push_back(verdict.leaders[g].row[l]);
        }
    }
    if (rows.empty()) return false;
    const auto features = at(stack_.features);
    WorkingColumn& working = column.working;
    const std::vector<int> old_rows = std::move(working.rows);
    const std::vector<double> old_weights = std::move(working.weights);
    rows.insert(rows.end(), old_rows.begin(), old_rows.end());
    std::sort(rows.begin(), rows.end());
    working.weights.assign(rows.size() * features, 0.0);
    working.group_begin.clear();
    column.groups.clear();
    std::size_t old = 0;
    for (std::size_t p = 0; p < rows.size(); ++p) {
        const int group = meshes_.group_of[at(rows[p])];
        if (column.groups.empty() || column.groups.back() != group) {
            column.groups.push_back(group);
            working.group_begin.push_back(static_cast<int>(p));
        }
        if (old < old_rows.size() && old_rows[old] == rows[p]) {
            std::copy_n(old_weights.begin() + static_cast<std::ptrdiff_t>(old * features), features,
                        working.weights.begin() + static_cast<std::ptrdiff_t>(p * features));
            ++old;
        }
    }
    working.group_begin.push_back(static_cast<int>(rows.size()));
    working.rows = std::move(rows);
    return true;
}

void MeshScopeSolver::solve_working_set(Column& column) {
    MeshScopeColumn model(stack_, penalties_, column.working);
    const auto stop = [&](const SpectralProgress& progress) {
        ++column.iterations;
        column.residual = progress.residual / (2.0 * stack_.largest_inner);
        const double gap = model.largest_decrease() + model.objective();
        const double target =
            std::max(-column.inner_gap * model.objective(), 0.1 * negligible * column.squared_norm);
        if (column.iterations >= options_.max_iterations) column.state = ColumnState::limit_reached;
        return gap <= target || progress.residual == 0.0 || column.state == ColumnState::limit_reached;
    };
    spectral_projected_gradient(model, model.first_step(), stop);
    column.decrease = -model.objective();
    column.reconstruction = model.reconstruction();
    for (std::size_t g = 0; g < column.groups.size(); ++g) {
        column.group_sums[at(column.groups[g])] = model.group_sums()[g];
    }
}

/// Appends the column's nonzero pairs, rows back in the problem's order.
void MeshScopeSolver::append_column(const Column& column, SolvedTile& tile) const {
    const auto features = at(stack_.features);
    std::vector<std::pair<int, std::size_t>> entries;
    for (std::size_t p = 0; p < column.working.rows.size(); ++p) {
        const auto begin = column.working.weights.begin() + static_cast<std::ptrdiff_t>(p * features);
        const bool positive = std::any_of(begin, begin + static_cast<std::ptrdiff_t>(features),
                                          [](double w) { return w > 0.0; });
        if (positive) entries.emplace_back(patch(column.working.rows[p]), p);
    }
    std::sort(entries.begin(), entries.end());
    for (const auto& [row, p] : entries) {
        tile.rows.push_back(row);
        const auto begin = column.working.weights.begin() + static_cast<std::ptrdiff_t>(p * features);
        tile.values.insert(tile.values.end(), begin, begin + static_cast<std::ptrdiff_t>(features));
    }
    tile.offsets.push_back(static_cast<std::int64_t>(tile.rows.size()));
}

/// Reserves memory for as many pairs as there will be if the columns to come are like those before, so that
/// the largest array of a large problem is not copied while it grows. The operating system does not provide
/// memory that is never written to.
void make_room(const SolvedTile& tile, SparseCoefficients& sparse) {
    const std::size_t pairs = sparse.rows.size() + tile.rows.size();
    if (pairs <= sparse.rows.capacity()) return;
    const auto columns = static_cast<double>(sparse.offsets.size() + tile.offsets.size() - 2);
    const double expected =
        1.2 * static_cast<double>(pairs) / columns * static_cast<double>(sparse.columns.size());
    const std::size_t room = std::max(pairs + pairs / 4, static_cast<std::size_t>(expected));
    sparse.rows.reserve(room);
    sparse.values.reserve(room * at(sparse.features));
}

/// Takes a finished tile into this rank's part of the answer.
void add_tile(const SolvedTile& tile, SparseCoefficients& sparse, ExactSum& sums, Totals& totals) {
    make_room(tile, sparse);
    const std::int64_t before = sparse.offsets.back();
    for (std::size_t c = 1; c < tile.offsets.size(); ++c) sparse.offsets.push_back(before + tile.offsets[c]);
    sparse.rows.insert(sparse.rows.end(), tile.rows.begin(), tile.rows.end());
    sparse.values.insert(sparse.values.end(), tile.values.begin(), tile.values.end());
    for (const double decrease : tile.decrease) sums.add_scalar(0, decrease);
    for (const double decrease : tile.largest_decrease) sums.add_scalar(1, decrease);
    totals.iterations = std::max(totals.iterations, tile.iterations);
    totals.passes = std::max(totals.passes, tile.passes);
    totals.working_pairs += tile.working_pairs;
    totals.residual = std::max(totals.residual, tile.residual);
    totals.limited = totals.limited || tile.limited;
    totals.rounds.push_back(tile.rounds);
}

/// The two ends of the gap, where the columns together have decreased the objective by this much, and no W
/// decreases it by more than `largest_decrease`.
HistoryRow certificate(const FeatureStack& stack, double decrease, double largest_decrease) {
    HistoryRow row;
    row.objective = stack.squared_norm - decrease;
    row.lower_bound =
        std::max(0.0, stack.squared_norm * (1.0 - stack.inner_product_error()) - largest_decrease);
    row.relative_gap = relative_gap(largest_decrease - decrease, decrease, stack.squared_norm);
    return row;
}

/// Collective. The last row is the answer's own.
void finish_history(const Comm& comm, const Totals& totals, const FeatureStack& stack, SolveResult& result) {
    const std::vector<ColumnRound> rounds = joined_rounds(comm, totals.rounds);
    for (std::size_t k = 0; k < rounds.size(); ++k) {
        HistoryRow row = certificate(stack, rounds[k].reached, rounds[k].bound);
        if (k + 1 == rounds.size())
            row = {0, 0, result.objective, result.lower_bound, result.relative_gap, 0};
        row.pass = k + 1 == rounds.size() ? result.passes : static_cast<int>(k) + 1;
        row.iterations = rounds[k].iterations;
        row.working_pairs = rounds[k].working_pairs;
        append_row(result.history, row);
    }
}

void finish_result(const Comm& comm, const Totals& totals, const MeshScopeSolver& solver, double gap,
                   ExactSum& sums, SolveResult& result) {
    const FeatureStack& stack = solver.stack();
    sums.reduce(comm);
    const double decrease = sums.scalar(0);
    const double largest_decrease = sums.scalar(1) * (1.0 + 1e-15);
    result.objective_at_zero = stack.squared_norm;
    const HistoryRow end = certificate(stack, decrease, largest_decrease);
    result.objective = end.objective;
    result.lower_bound = end.lower_bound;
    result.relative_gap = end.relative_gap;
    result.kkt_residual = all_max(comm, totals.residual);
    result.iterations = all_max(comm, totals.iterations);
    result.passes = all_max(comm, totals.passes);
    result.working_pairs = all_sum(comm, totals.working_pairs);
    result.nonzero_groups = all_sum(comm, static_cast<std::int64_t>(result.coefficients.rows.size()));
    finish_history(comm, totals, stack, result);
    const bool timed_out = any_rank(comm, solver.timed_out());
    const bool limited = any_rank(comm, totals.limited);
    if (result.relative_gap <= gap) {
        result.reason = StopReason::gap_reached;
    } else if (limited) {
        result.reason = timed_out ? StopReason::time_limit : StopReason::iteration_limit;
    } else {
        result.reason = StopReason::residual_reached;
    }
}

}  // namespace

SolveResult solve_mesh_scope(const Comm& comm, const SubspaceProblem& problem, const SolveOptions& options) {
    MeshScopeSolver solver(comm, problem, options);
    SolveResult result;
    const BlockRange owned = block_range(problem.size(), comm.size(), comm.rank(), coefficient_tile);
    result.coefficients = {problem.size(), owned, problem.feature_count(), {0}, {}, {}};
    ExactSum sums(2);
    Totals totals;
    bool stopped = false;
    SolverCheckpoint* checkpoint = options.checkpoint;
    if (checkpoint != nullptr) checkpoint->open(problem, options, owned);
    for (std::int64_t begin = owned.begin; begin < owned.end && !stopped; begin += coefficient_tile) {
        const std::optional<SolvedTile> known =
            checkpoint != nullptr ? checkpoint->find(begin) : std::nullopt;
        const SolvedTile tile =
            known ? *known : solver.solve_tile(begin, std::min(begin + coefficient_tile, owned.end));
        add_tile(tile, result.coefficients, sums, totals);
        if (options.progress) options.progress(tile.end - owned.begin, owned.size());
        if (checkpoint == nullptr) continue;
        if (!known && !solver.timed_out()) checkpoint->keep(tile);
        stopped = checkpoint->should_stop();
    }
    if (checkpoint != nullptr) checkpoint->close(stopped);
    finish_result(comm, totals, solver, options.gap, sums, result);
    return result;
}

}  // namespace coseg
