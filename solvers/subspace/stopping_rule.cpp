#include "solvers/subspace/stopping_rule.hpp"

#include <algorithm>
#include <cmath>

namespace coseg {

StoppingRule::StoppingRule(const Comm& comm, const SolveOptions& options, double objective_at_zero)
    : comm_(comm), options_(options), objective_at_zero_(objective_at_zero), objective_(objective_at_zero) {}

bool StoppingRule::certify(double objective, double lower_bound) {
    objective_ = objective;
    lower_bound_ = std::max(lower_bound_, lower_bound);
    return relative_gap() <= options_.gap;
}

bool StoppingRule::limit_reached(int iterations, double kkt_residual) {
    if (options_.progress) options_.progress(0, 1);
    if (kkt_residual <= smallest_residual) {
        limit_ = StopReason::residual_reached;
        return true;
    }
    if (iterations >= options_.max_iterations) {
        limit_ = StopReason::iteration_limit;
        return true;
    }
    if (all_max(comm_, clock_.seconds()) >= options_.max_seconds) {
        limit_ = StopReason::time_limit;
        return true;
    }
    return false;
}

double StoppingRule::scale(double objective) const {
    return gap_scale(PenaltyScope::rows, objective, objective_at_zero_);
}

double StoppingRule::relative_gap() const {
    return coseg::relative_gap(objective_ - lower_bound_, scale(objective_), objective_at_zero_);
}

void StoppingRule::report(SolveResult& result) const {
    result.objective = objective_;
    result.objective_at_zero = objective_at_zero_;
    result.lower_bound = lower_bound_;
    result.relative_gap = relative_gap();
    result.reason = result.relative_gap <= options_.gap ? StopReason::gap_reached : limit_;
}

double gradient_scale(const FeatureStack& stack) {
    return 2.0 * stack.largest_inner * std::sqrt(static_cast<double>(stack.features) * stack.size);
}

double row_sum_scale(const FeatureStack& stack, double lambda) {
    return lambda > 0.0 ? std::sqrt(stack.squared_norm / lambda) : 1.0;
}

}  // namespace coseg
