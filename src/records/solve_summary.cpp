#include "src/records/solve_summary.hpp"

#include <algorithm>

namespace coseg {

double relative_gap(double width, double scale, double objective_at_zero) {
    const double open = std::max(width, 0.0);
    if (scale > 0.0) return open / scale;
    return open <= 1e-14 * objective_at_zero ? 0.0 : 1.0;
}

void add_certificate(SolveSummary& sum, const SolveSummary& one) {
    sum.objective += one.objective;
    sum.objective_at_zero += one.objective_at_zero;
    sum.lower_bound += one.lower_bound;
    sum.working_pairs += one.working_pairs;
    sum.nonzero_groups += one.nonzero_groups;
    sum.passes += one.passes;
    sum.kkt_residual = std::max(sum.kkt_residual, one.kkt_residual);
    sum.iterations = std::max(sum.iterations, one.iterations);
    sum.reason = std::max(sum.reason, one.reason);
}

}  // namespace coseg
