#pragma once
// Decides when to stop, in the same way on all ranks: at a duality gap, a proximal-gradient residual, or a
// limit.

#include "solvers/subspace/feature_stack.hpp"
#include "solvers/subspace/solve_result.hpp"
#include "solvers/subspace/subspace_problem.hpp"
#include "src/base/stopwatch.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

/// The rule of row scope. It remembers the best lower bound. The objective is that of the last point
/// certified.
class StoppingRule {
  public:
    /// Starts the clock.
    StoppingRule(const Comm& comm, const SolveOptions& options, double objective_at_zero);

    /// True once the gap is small enough.
    bool certify(double objective, double lower_bound);

    /// True once the residual is down to rounding, or iterations or time have run out. Collective.
    bool limit_reached(int iterations, double kkt_residual);

    /// Records the reason why the gap will not become smaller.
    void give_up(StopReason reason) { limit_ = reason; }

    [[nodiscard]] double relative_gap() const;
    [[nodiscard]] double lower_bound() const noexcept { return lower_bound_; }
    [[nodiscard]] StopReason limit() const noexcept { return limit_; }

    /// The value that gaps are relative to.
    [[nodiscard]] double scale(double objective) const;

    /// Fills in bounds, gap and reason.
    void report(SolveResult& result) const;

  private:
    const Comm& comm_;
    SolveOptions options_;
    double objective_at_zero_;
    Stopwatch clock_;
    double objective_;
    double lower_bound_ = 0.0;
    StopReason limit_ = StopReason::iteration_limit;
};

/// Residuals below this are rounding: the gap cannot be closed any further in double precision.
inline constexpr double smallest_residual = 1e-14;

/// The value that residuals are relative to: an upper bound of the norm of the gradient at W = 0 along its
/// largest entries, one for each column and feature.
double gradient_scale(const FeatureStack& stack);

/// An upper bound of the row sums of any useful W: lambda ||r||^2 is at most the objective at W = 0.
double row_sum_scale(const FeatureStack& stack, double lambda);

}  // namespace coseg
