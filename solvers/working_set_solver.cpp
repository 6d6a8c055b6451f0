#include "solvers/working_set_solver.hpp"

#include <algorithm>
#include <cmath>

#include "solvers/all_pairs_pass.hpp"
#include "solvers/stopping_rule.hpp"
#include "solvers/working_set_model.hpp"

namespace coseg {

namespace {

constexpr int inner_check_interval = 5;
/// Newton's direction is tried from this iteration on a working set on, after each check; what gradient steps solve
/// quickly, as where lambda is large, does not get there.
constexpr int first_newton_step = 15;
/// A step that is cut short, for the support is not the optimum's yet, makes the next one wait twice as long, up to this many checks.
constexpr int longest_newton_wait = 6;
constexpr double smallest_inner_gap = 1e-16;
/// Pairs that stay zero leave after each of the first passes; later they stay, so that no pair can come and
/// go for ever.
constexpr int passes_that_shrink = 6;

bool is_zero(const ColumnFit& fit, std::size_t pair, std::size_t features) {
    const auto begin = fit.weights.begin() + static_cast<std::ptrdiff_t>(pair * features);
    return std::all_of(begin, begin + static_cast<std::ptrdiff_t>(features),
                       [](double w) { return w == 0.0; });
}

/// Adds the rows `entering` (none of them in the set) and, if asked to, drops pairs that are zero.
void update_fit(const FeatureStack& stack, int column, const std::vector<int>& entering, bool shrink,
                ColumnFit& fit) {
    const auto features = static_cast<std::size_t>(stack.features);
    ColumnFit next;
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
    prepare_column_fit(stack, column, next);
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
    const auto features = static_cast<std::size_t>(stack.features);
    SparseCoefficients sparse{stack.size, working.columns, stack.features, {0}, {}, {}};
    for (const ColumnFit& fit : working.fits) {
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
};

/// Spectral projected gradient on the working set until its own gap is small enough, or a limit.
void solve_inside(const Comm& comm, const SubspaceProblem& problem, const FeatureStack& stack,
                  WorkingSet& working, std::vector<double>& prices, StoppingRule& rule, Progress& progress,
                  SolveResult& result) {
    WorkingSetModel model(comm, problem, stack, working, prices);
    const int before = result.iterations;
    int wait = 1;
    int next_newton = first_newton_step;
    const auto stop = [&](const SpectralProgress& inner) {
        result.iterations = before + inner.iterations;
        result.kkt_residual = inner.residual / gradient_scale(stack);
        if (inner.residual == 0.0) return true;
        if (inner.iterations % inner_check_interval != 0) return false;
        progress.limited = rule.limit_reached(result.iterations, 1.0);
        const double gap = model.objective() - model.lower_bound();
        if (progress.limited || gap <= progress.inner_gap * rule.scale(model.objective())) return true;
        if (inner.iterations >= next_newton) {
            wait = model.newton_step() == 1.0 ? 1 : std::min(2 * wait, longest_newton_wait);
            next_newton = inner.iterations + wait * inner_check_interval;
        }
        return false;
    };
    spectral_projected_gradient(model, 0.5 / stack.largest_inner, stop);
    model.store(working);
    progress.objective = model.objective();
    progress.row_sums = model.row_sums();
}

}  // namespace

SolveResult solve_working_set(const Comm& comm, const SubspaceProblem& problem, const SolveOptions& options) {
    const FeatureStack stack = stack_features(problem);
    WorkingSet working;
    working.columns = block_range(stack.size, comm.size(), comm.rank(), coefficient_tile);
    working.fits.resize(static_cast<std::size_t>(working.columns.size()));
    std::vector<double> prices(working.fits.size() * static_cast<std::size_t>(stack.features), 0.0);
    AllPairsPass pass(comm, problem, stack);
    StoppingRule rule(comm, options, stack.squared_norm);
    SolveResult result;
    PassFindings findings = pass.first(working);
    result.passes = 1;
    Progress progress{.objective = stack.squared_norm, .row_sums = {}, .inner_gap = 1e-2};
    while (!rule.certify(progress.objective, findings.lower_bound) && !progress.limited) {
        // Solve the working set to a part of the gap that is left; more only where nothing else closes it.
        if (findings.entering_pairs > 0) {
            progress.inner_gap =
                std::max(std::min(progress.inner_gap, 0.1 * rule.relative_gap()), 0.3 * options.gap);
        } else {
            progress.inner_gap *= 0.1;
        }
        if (progress.inner_gap < smallest_inner_gap) {
            rule.give_up(StopReason::residual_reached);
            break;
        }
        update_working_set(stack, findings, result.passes > 1 && result.passes <= passes_that_shrink,
                           working);
        solve_inside(comm, problem, stack, working, prices, rule, progress, result);
        findings = pass.run(working, progress.row_sums);
        ++result.passes;
    }
    result.pass_cost = pass.cost();
    result.coefficients = nonzero_pairs(stack, working);
    result.working_pairs = all_sum(comm, working.pair_count());
    result.nonzero_groups = all_sum(comm, static_cast<std::int64_t>(result.coefficients.rows.size()));
    rule.report(result);
    return result;
}

}  // namespace coseg
