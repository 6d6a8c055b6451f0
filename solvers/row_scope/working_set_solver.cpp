#include "solvers/row_scope/working_set_solver.hpp"

#include <algorithm>
#include <cmath>

#include "solvers/row_scope/all_pairs_pass.hpp"
#include "solvers/row_scope/working_set_model.hpp"
#include "solvers/subspace/solver_checkpoint.hpp"
#include "solvers/subspace/stopping_rule.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

constexpr int inner_check_interval = 5;
/// Proximal points are taken from this iteration on a working set on, one after each check; what gradient
/// steps solve quickly, as where lambda is large, does not get there.
constexpr int first_proximal_step = 15;
/// Of the first proximal point on a working set, in units of the shortest gradient step. Where Newton's
/// method finds one quickly the next reaches further, which brings it nearer to the optimum; where it does
/// not, none will reach as far again.
constexpr double first_reach = 10.0;
constexpr double largest_reach = 1e5;
constexpr double reach_growth = 3.0;
constexpr int quick_newton_steps = 6;
constexpr double smallest_inner_gap = 1e-16;
/// Pairs that stay zero leave after each of the first passes; later they stay, so that no pair can come and
/// go for ever.
constexpr int passes_that_shrink = 6;

bool is_zero(const RowScopeColumn& fit, std::size_t pair, std::size_t features) {
    const auto begin = fit.weights.begin() + static_cast<std::ptrdiff_t>(pair * features);
    return std::all_of(begin, begin + static_cast<std::ptrdiff_t>(features),
                       [](double w) { return w == 0.0; });
}

/// Adds the rows `entering` (none of them in the set) and, if asked to, drops pairs that are zero.
void update_fit(const FeatureStack& stack, int column, const std::vector<int>& entering, bool shrink,
                RowScopeColumn& fit) {
    const auto features = at(stack.features);
    RowScopeColumn next;
    std::size_t old = 0, added = 0;
    while (old < fit.rows.size() || added < entering.size()) {
        const bool is_old =
            added == entering.size() || (old < fit.rows.size() && fit.rows[old] < entering[added]);
        if (is_old && shrink && is_zero(fit, old, features)) {
            ++old;
            continue;
        }
        next.rows.push_back(is_old ? fit.rows[old] : entering[added]);
        const auto from = fit.weights.begin() + static_cast<std::ptrdiff_t>(old * features);
        if (is_old)
            next.weights.insert(next.weights.end(), from, from + static_cast<std::ptrdiff_t>(features));
        next.weights.resize(next.rows.size() * features, 0.0);
        ++(is_old ? old : added);
    }
    if (next.rows == fit.rows) return;
    prepare_row_scope_column(stack, column, next);
    fit = std::move(next);
}

void update_working_set(const FeatureStack& stack, const PassFindings& findings, bool shrink,
                        WorkingSet& working) {
    for (std::size_t c = 0; c < working.fits.size(); ++c) {
        const int column = static_cast<int>(working.columns.begin) + static_cast<int>(c);
        update_fit(stack, column, findings.entering[c], shrink, working.fits[c]);
    }
}

SparseCoefficients nonzero_pairs(const FeatureStack& stack, const WorkingSet& working) {
    const auto features = at(stack.features);
    SparseCoefficients sparse{stack.size, working.columns, stack.features, {0}, {}, {}};
    for (const RowScopeColumn& fit : working.fits) {
        for (std::size_t p = 0; p < fit.rows.size(); ++p) {
            if (is_zero(fit, p, features)) continue;
            sparse.rows.push_back(fit.rows[p]);
            const auto from = fit.weights.begin() + static_cast<std::ptrdiff_t>(p * features);
            sparse.values.insert(sparse.values.end(), from, from + static_cast<std::ptrdiff_t>(features));
        }
        sparse.offsets.push_back(static_cast<std::int64_t>(sparse.rows.size()));
    }
    return sparse;
}

/// The iteration's state between passes.
struct Progress {
    double objective = 0.0;
    std::vector<double> row_sums;
    double inner_gap = 0.0;  ///< asked of the working set's problem
    bool limited = false;
    bool stopped = false;  ///< by the checkpoint: the iterate is kept, and another run continues
};

/// The working set as a checkpoint keeps it; the rest of the iterate is the caller's.
SolveIterate iterate_of(const WorkingSet& working, const std::vector<double>& prices) {
    SolveIterate iterate;
    iterate.columns = working.columns;
    iterate.offsets = {0};
    for (const RowScopeColumn& fit : working.fits) {
        iterate.rows.insert(iterate.rows.end(), fit.rows.begin(), fit.rows.end());
        iterate.weights.insert(iterate.weights.end(), fit.weights.begin(), fit.weights.end());
        iterate.offsets.push_back(static_cast<std::int64_t>(iterate.rows.size()));
    }
    iterate.prices = prices;
    return iterate;
}

void restore(const FeatureStack& stack, const SolveIterate& iterate, WorkingSet& working,
             std::vector<double>& prices) {
    const std::ptrdiff_t features = stack.features;
    for (std::size_t c = 0; c < working.fits.size(); ++c) {
        const std::ptrdiff_t begin = iterate.offsets[c];
        const std::ptrdiff_t end = iterate.offsets[c + 1];
        working.fits[c].rows.assign(iterate.rows.begin() + begin, iterate.rows.begin() + end);
        working.fits[c].weights.assign(iterate.weights.begin() + begin * features,
                                       iterate.weights.begin() + end * features);
        prepare_row_scope_column(stack, static_cast<int>(working.columns.begin) + static_cast<int>(c),
                                 working.fits[c]);
    }
    prices = iterate.prices;
}

ProximalTurns first_turn(double shortest_step, const Progress& progress, const StoppingRule& rule) {
    return {.next = first_proximal_step,
            .reach = first_reach * shortest_step,
            .largest_reach = largest_reach * shortest_step,
            .sufficient_gap = std::max(progress.inner_gap, 0.1 * rule.relative_gap())};
}

void take_turn(WorkingSetModel& model, int iteration, ProximalTurns& turns) {
    const std::optional<int> newton_steps = model.proximal_step(turns.reach);
    turns.next = iteration + inner_check_interval;
    if (!newton_steps) {
        turns.reach /= reach_growth;
        turns.largest_reach = turns.reach;
    } else if (*newton_steps <= quick_newton_steps) {
        turns.reach = std::min(turns.reach * reach_growth, turns.largest_reach);
    }
}

/// Spectral projected gradient on the working set, with proximal points in between where it is slow, until
/// its own gap is small enough, or a limit, or the checkpoint stops it. from: where an earlier run was in
/// this very solve, if it was.
void solve_inside(const Comm& comm, const SubspaceProblem& problem, const FeatureStack& stack,
                  WorkingSet& working, std::vector<double>& prices, StoppingRule& rule, Progress& progress,
                  SolveResult& result, SolverCheckpoint* checkpoint, const SolveIterate* from) {
    WorkingSetModel model(comm, problem, stack, working, prices);
    const int before = result.iterations;
    const double shortest_step = 0.5 / stack.largest_inner;
    ProximalTurns turns = from != nullptr ? from->proximal : first_turn(shortest_step, progress, rule);
    const auto keep = [&](const SpectralProgress& inner) {
        const CheckpointAction turn = checkpoint->turn();
        progress.stopped = turn == CheckpointAction::keep_and_stop;
        if (turn == CheckpointAction::go_on) return;
        model.store(working);
        SolveIterate iterate = iterate_of(working, prices);
        iterate.spectral = inner.state;
        iterate.inner_gap = progress.inner_gap;
        iterate.lower_bound = rule.lower_bound();
        iterate.iterations = before;
        iterate.passes = result.passes;
        iterate.proximal = turns;
        iterate.history = result.history;
        checkpoint->keep_iterate(iterate);
    };
    const auto stop = [&](const SpectralProgress& inner) {
        result.iterations = before + inner.iterations;
        result.kkt_residual = inner.residual / gradient_scale(stack);
        if (inner.residual == 0.0) return true;
        if (inner.iterations % inner_check_interval != 0) return false;
        progress.limited = rule.limit_reached(result.iterations, 1.0);
        const double gap = model.objective() - model.lower_bound();
        const double enough =
            inner.iterations < first_proximal_step ? progress.inner_gap : turns.sufficient_gap;
        if (progress.limited || gap <= enough * rule.scale(model.objective())) return true;
        if (inner.iterations >= turns.next) take_turn(model, inner.iterations, turns);
        // After the step, so that a run that continues from here is where this one is.
        if (checkpoint != nullptr) keep(inner);
        return progress.stopped;
    };
    if (from != nullptr)
        spectral_projected_gradient(model, from->spectral, stop);
    else
        spectral_projected_gradient(model, shortest_step, stop);
    model.store(working);
    progress.objective = model.objective();
    progress.row_sums = model.row_sums();
}

/// Counts a pass, and makes what it has found a row of the history. Returns whether the gap is small enough.
/// Collective.
bool record(const Comm& comm, StoppingRule& rule, const Progress& progress, const PassFindings& findings,
            const WorkingSet& working, SolveResult& result) {
    ++result.passes;
    const bool reached = rule.certify(progress.objective, findings.lower_bound);
    append_row(result.history, {.pass = result.passes,
                                .iterations = result.iterations,
                                .objective = progress.objective,
                                .lower_bound = rule.lower_bound(),
                                .relative_gap = rule.relative_gap(),
                                .working_pairs = all_sum(comm, working.pair_count())});
    return reached;
}

/// Takes up an iterate that a checkpoint has kept. A finished one leaves nothing to do.
PassFindings resume(const FeatureStack& stack, const SolveIterate& known, WorkingSet& working,
                    std::vector<double>& prices, StoppingRule& rule, Progress& progress,
                    SolveResult& result) {
    restore(stack, known, working, prices);
    progress.inner_gap = known.inner_gap;
    result.iterations = known.iterations;
    result.passes = known.passes;
    result.history = known.history;
    if (known.finished) {
        progress.objective = known.objective;
        progress.limited = true;
        result.kkt_residual = known.residual;
        rule.give_up(static_cast<StopReason>(known.reason));
    }
    PassFindings findings;
    findings.lower_bound = known.lower_bound;
    return findings;
}

/// Keeps the end of the solve, unless it is the clock's, and ends the run where the checkpoint has stopped
/// it.
void close_checkpoint(SolverCheckpoint& checkpoint, const WorkingSet& working,
                      const std::vector<double>& prices, const StoppingRule& rule, const Progress& progress,
                      const SolveResult& result, bool was_finished) {
    if (!progress.stopped && !was_finished && rule.limit() != StopReason::time_limit) {
        SolveIterate iterate = iterate_of(working, prices);
        iterate.lower_bound = rule.lower_bound();
        iterate.iterations = result.iterations;
        iterate.passes = result.passes;
        iterate.history = result.history;
        iterate.finished = true;
        iterate.objective = progress.objective;
        iterate.residual = result.kkt_residual;
        iterate.reason = static_cast<int>(rule.limit());
        checkpoint.keep_iterate(iterate);
    }
    checkpoint.close(progress.stopped);
}

/// What the next solve on the working set is asked for, and the pairs that it is on; false if nothing closes
/// the gap.
bool prepare_solve(const FeatureStack& stack, const PassFindings& findings, const SolveOptions& options,
                   int passes, StoppingRule& rule, WorkingSet& working, Progress& progress) {
    // Solve the working set to a part of the gap that is left; more only where nothing else closes it.
    if (findings.entering_pairs > 0) {
        progress.inner_gap =
            std::max(std::min(progress.inner_gap, 0.1 * rule.relative_gap()), 0.3 * options.gap);
    } else {
        progress.inner_gap *= 0.1;
    }
    if (progress.inner_gap < smallest_inner_gap) {
        rule.give_up(StopReason::residual_reached);
        return false;
    }
    update_working_set(stack, findings, passes > 1 && passes <= passes_that_shrink, working);
    return true;
}

}  // namespace

SolveResult solve_working_set(const Comm& comm, const SubspaceProblem& problem, const SolveOptions& options) {
    const FeatureStack stack = stack_features(problem);
    WorkingSet working;
    working.columns = block_range(stack.size, comm.size(), comm.rank(), coefficient_tile);
    working.fits.resize(at(working.columns.size()));
    std::vector<double> prices(working.fits.size() * at(stack.features), 0.0);
    AllPairsPass pass(comm, problem, stack);
    StoppingRule rule(comm, options, stack.squared_norm);
    SolveResult result;
    Progress progress{.objective = stack.squared_norm, .row_sums = {}, .inner_gap = 1e-2};
    SolverCheckpoint* checkpoint = options.checkpoint;
    if (checkpoint != nullptr) checkpoint->open(problem, options, working.columns);
    std::optional<SolveIterate> known =
        checkpoint != nullptr ? checkpoint->find_iterate() : std::optional<SolveIterate>();
    const bool was_finished = known && known->finished;
    PassFindings findings =
        known ? resume(stack, *known, working, prices, rule, progress, result) : pass.first(working);
    bool reached = known ? rule.certify(progress.objective, findings.lower_bound)
                         : record(comm, rule, progress, findings, working, result);
    while (!reached && !progress.limited) {
        const bool goes_on =
            known || prepare_solve(stack, findings, options, result.passes, rule, working, progress);
        if (!goes_on) break;
        solve_inside(comm, problem, stack, working, prices, rule, progress, result, checkpoint,
                     known ? &*known : nullptr);
        known.reset();
        if (progress.stopped) break;
        findings = pass.run(working, progress.row_sums);
        reached = record(comm, rule, progress, findings, working, result);
    }
    if (checkpoint != nullptr)
        close_checkpoint(*checkpoint, working, prices, rule, progress, result, was_finished);
    result.pass_cost = pass.cost();
    result.coefficients = nonzero_pairs(stack, working);
    result.working_pairs = all_sum(comm, working.pair_count());
    result.nonzero_groups = all_sum(comm, static_cast<std::int64_t>(result.coefficients.rows.size()));
    rule.report(result);
    return result;
}

}  // namespace coseg
