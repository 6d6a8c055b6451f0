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
/// Pairs that stay zero leave after each of the first passes. Later they stay, so that no pair can come and
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

ProximalTurns first_turn(double shortest_step, double sufficient_gap) {
    return {.next = first_proximal_step,
            .reach = first_reach * shortest_step,
            .largest_reach = largest_reach * shortest_step,
            .sufficient_gap = sufficient_gap};
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

/// The solve of one problem, from pass to pass: the working set and what is known of W on it.
class WorkingSetSolve {
  public:
    /// Collective, as is all that is public.
    WorkingSetSolve(const Comm& comm, const SubspaceProblem& problem, const SolveOptions& options);
    SolveResult run();

  private:
    /// The state of a solve on the working set as it is now.
    struct InnerSolve {
        WorkingSetModel& model;
        ProximalTurns turns;
        int iterations_before = 0;
    };

    void solve_inside(const SolveIterate* from);
    bool ends(InnerSolve& inner, const SpectralProgress& progress);
    void keep(const InnerSolve& inner, const SpectralProgress& progress);
    [[nodiscard]] SolveIterate iterate() const;
    PassFindings resume(const SolveIterate& known);
    bool record(const PassFindings& findings);
    bool prepare(const PassFindings& findings);
    void close_checkpoint(bool was_finished);

    const Comm& comm_;
    const SubspaceProblem& problem_;
    const SolveOptions& options_;
    FeatureStack stack_;
    WorkingSet working_;
    std::vector<double> prices_;
    AllPairsPass pass_;
    StoppingRule rule_;
    SolveResult result_;
    double objective_;
    std::vector<double> row_sums_;
    double inner_gap_ = 1e-2;  ///< asked of the working set's problem
    bool limited_ = false;
    bool stopped_ = false;  ///< by the checkpoint: the iterate is kept, and another run continues
};

WorkingSet empty_set(const Comm& comm, const FeatureStack& stack) {
    WorkingSet working;
    working.columns = block_range(stack.size, comm.size(), comm.rank(), coefficient_tile);
    working.fits.resize(at(working.columns.size()));
    return working;
}

WorkingSetSolve::WorkingSetSolve(const Comm& comm, const SubspaceProblem& problem,
                                 const SolveOptions& options)
    : comm_(comm),
      problem_(problem),
      options_(options),
      stack_(stack_features(problem)),
      working_(empty_set(comm, stack_)),
      prices_(working_.fits.size() * at(stack_.features), 0.0),
      pass_(comm, problem, stack_, options.pair_scorer),
      rule_(comm, options, stack_.squared_norm),
      objective_(stack_.squared_norm) {}

/// The working set as a checkpoint keeps it, and how far the solve has come; the rest of the iterate is the
/// caller's.
SolveIterate WorkingSetSolve::iterate() const {
    SolveIterate iterate;
    iterate.columns = working_.columns;
    iterate.offsets = {0};
    for (const RowScopeColumn& fit : working_.fits) {
        iterate.rows.insert(iterate.rows.end(), fit.rows.begin(), fit.rows.end());
        iterate.weights.insert(iterate.weights.end(), fit.weights.begin(), fit.weights.end());
        iterate.offsets.push_back(static_cast<std::int64_t>(iterate.rows.size()));
    }
    iterate.prices = prices_;
    iterate.lower_bound = rule_.lower_bound();
    iterate.iterations = result_.iterations;
    iterate.passes = result_.passes;
    iterate.history = result_.history;
    return iterate;
}

/// Keeps the iterate inside a solve if the checkpoint asks for it.
void WorkingSetSolve::keep(const InnerSolve& inner, const SpectralProgress& progress) {
    const CheckpointAction turn = options_.checkpoint->turn();
    stopped_ = turn == CheckpointAction::keep_and_stop;
    if (turn == CheckpointAction::go_on) return;
    inner.model.store(working_);
    SolveIterate kept = iterate();
    kept.spectral = progress.state;
    kept.inner_gap = inner_gap_;
    kept.iterations = inner.iterations_before;
    kept.proximal = inner.turns;
    options_.checkpoint->keep_iterate(kept);
}

/// Whether the solve on the working set ends here: its gap is small enough, or a limit or the checkpoint
/// stops it.
bool WorkingSetSolve::ends(InnerSolve& inner, const SpectralProgress& progress) {
    result_.iterations = inner.iterations_before + progress.iterations;
    result_.kkt_residual = progress.residual / gradient_scale(stack_);
    if (progress.residual == 0.0) return true;
    if (progress.iterations % inner_check_interval != 0) return false;
    limited_ = rule_.limit_reached(result_.iterations, 1.0);
    const double gap = inner.model.objective() - inner.model.lower_bound();
    const double enough = progress.iterations < first_proximal_step ? inner_gap_ : inner.turns.sufficient_gap;
    if (limited_ || gap <= enough * rule_.scale(inner.model.objective())) return true;
    if (progress.iterations >= inner.turns.next) take_turn(inner.model, progress.iterations, inner.turns);
    // This comes after the step, so that a run that continues from here has the same state as this one.
    if (options_.checkpoint != nullptr) keep(inner, progress);
    return stopped_;
}

/// Spectral projected gradient on the working set, with proximal points in between where it is slow.
/// from: where an earlier run was in this very solve, if it was.
void WorkingSetSolve::solve_inside(const SolveIterate* from) {
    WorkingSetModel model(comm_, problem_, stack_, working_, prices_);
    const double shortest_step = 0.5 / stack_.largest_inner;
    const double sufficient_gap = std::max(inner_gap_, 0.1 * rule_.relative_gap());
    InnerSolve inner{model, from != nullptr ? from->proximal : first_turn(shortest_step, sufficient_gap),
                     result_.iterations};
    const auto stop = [&](const SpectralProgress& progress) { return ends(inner, progress); };
    if (from != nullptr)
        spectral_projected_gradient(model, from->spectral, stop);
    else
        spectral_projected_gradient(model, shortest_step, stop);
    model.store(working_);
    objective_ = model.objective();
    row_sums_ = model.row_sums();
}

/// Counts a pass, and makes what it has found a row of the history. Returns whether the gap is small enough.
bool WorkingSetSolve::record(const PassFindings& findings) {
    ++result_.passes;
    const bool reached = rule_.certify(objective_, findings.lower_bound);
    append_row(result_.history, {.pass = result_.passes,
                                 .iterations = result_.iterations,
                                 .objective = objective_,
                                 .lower_bound = rule_.lower_bound(),
                                 .relative_gap = rule_.relative_gap(),
                                 .working_pairs = all_sum(comm_, working_.pair_count())});
    return reached;
}

/// Continues from an iterate that a checkpoint has kept. A finished one leaves nothing to do.
PassFindings WorkingSetSolve::resume(const SolveIterate& known) {
    restore(stack_, known, working_, prices_);
    inner_gap_ = known.inner_gap;
    result_.iterations = known.iterations;
    result_.passes = known.passes;
    result_.history = known.history;
    if (known.finished) {
        objective_ = known.objective;
        limited_ = true;
        result_.kkt_residual = known.residual;
        rule_.give_up(known.reason);
    }
    PassFindings findings;
    findings.lower_bound = known.lower_bound;
    return findings;
}

/// Keeps the end of the solve, unless it is the clock's, and ends the run where the checkpoint has stopped
/// it.
void WorkingSetSolve::close_checkpoint(bool was_finished) {
    if (!stopped_ && !was_finished && rule_.limit() != StopReason::time_limit) {
        SolveIterate kept = iterate();
        kept.finished = true;
        kept.objective = objective_;
        kept.residual = result_.kkt_residual;
        kept.reason = rule_.limit();
        options_.checkpoint->keep_iterate(kept);
    }
    options_.checkpoint->close(stopped_);
}

/// Chooses the accuracy of the next solve on the working set, and the pairs that it is on. Returns false if
/// nothing closes the gap.
bool WorkingSetSolve::prepare(const PassFindings& findings) {
    // Solve the working set to a part of the gap that is left; more only where nothing else closes it.
    if (findings.entering_pairs > 0)
        inner_gap_ = std::max(std::min(inner_gap_, 0.1 * rule_.relative_gap()), 0.3 * options_.gap);
    else
        inner_gap_ *= 0.1;
    if (inner_gap_ < smallest_inner_gap) {
        rule_.give_up(StopReason::residual_reached);
        return false;
    }
    update_working_set(stack_, findings, result_.passes > 1 && result_.passes <= passes_that_shrink,
                       working_);
    return true;
}

SolveResult WorkingSetSolve::run() {
    SolverCheckpoint* checkpoint = options_.checkpoint;
    if (checkpoint != nullptr) checkpoint->open(problem_, options_, working_.columns);
    std::optional<SolveIterate> known =
        checkpoint != nullptr ? checkpoint->find_iterate() : std::optional<SolveIterate>();
    const bool was_finished = known && known->finished;
    PassFindings findings = known ? resume(*known) : pass_.first(working_);
    bool reached = known ? rule_.certify(objective_, findings.lower_bound) : record(findings);
    while (!reached && !limited_) {
        if (!known && !prepare(findings)) break;
        solve_inside(known ? &*known : nullptr);
        known.reset();
        if (stopped_) break;
        findings = pass_.run(working_, row_sums_);
        reached = record(findings);
    }
    if (checkpoint != nullptr) close_checkpoint(was_finished);
    result_.pass_cost = pass_.cost();
    result_.coefficients = nonzero_pairs(stack_, working_);
    result_.working_pairs = all_sum(comm_, working_.pair_count());
    result_.nonzero_groups = all_sum(comm_, static_cast<std::int64_t>(result_.coefficients.rows.size()));
    rule_.report(result_);
    return std::move(result_);
}

}  // namespace

SolveResult solve_working_set(const Comm& comm, const SubspaceProblem& problem, const SolveOptions& options) {
    return WorkingSetSolve(comm, problem, options).run();
}

}  // namespace coseg
