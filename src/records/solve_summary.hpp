#pragma once
// Says how close a solve came to the optimum, and how it got there.

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "src/records/fields.hpp"

namespace coseg {

/// From best to worst.
enum class StopReason { gap_reached, residual_reached, iteration_limit, time_limit };
constexpr std::array<EnumName<StopReason>, 4> enum_names(StopReason /*type*/) {
    return {{{StopReason::gap_reached, "gap_reached"},
             {StopReason::residual_reached, "residual_reached"},
             {StopReason::iteration_limit, "iteration_limit"},
             {StopReason::time_limit, "time_limit"}}};
}

/// The state of the whole problem after a pass over all pairs. It is the same on all ranks and on any number
/// of ranks.
struct HistoryRow {
    int pass = 0;        ///< from 1
    int iterations = 0;  ///< so far; where columns are independent, of the column that took most
    double objective = 0.0;
    double lower_bound = 0.0;        ///< the best so far
    double relative_gap = 0.0;       ///< as SolveSummary::relative_gap
    std::int64_t working_pairs = 0;  ///< in the working set at the time of the pass

    bool operator==(const HistoryRow&) const = default;
    static constexpr auto fields() {
        return std::tuple(field("pass", &HistoryRow::pass), field("iterations", &HistoryRow::iterations),
                          field("objective", &HistoryRow::objective),
                          field("lower_bound", &HistoryRow::lower_bound),
                          field("relative_gap", &HistoryRow::relative_gap),
                          field("working_pairs", &HistoryRow::working_pairs));
    }
};

using SolveHistory = std::vector<HistoryRow>;

/// The certificate of a solve; the same on all ranks.
struct SolveSummary {
    double objective = 0.0;          ///< at the coefficients; an upper bound of the optimum
    double objective_at_zero = 0.0;  ///< sum_h ||X_h||_F^2
    double lower_bound = 0.0;        ///< of the optimum; rounding is allowed for
    /// (objective - lower_bound) / max(objective, 1e-6 objective_at_zero) in row scope; in mesh scope the
    /// divisor is objective_at_zero - objective. 0 where both bounds agree to the last bits.
    double relative_gap = 0.0;
    double kkt_residual = 0.0;        ///< norm of (W - prox(W - t G)) / t, relative to the size of G at W = 0
    int iterations = 0;               ///< in mesh scope, of the column that took most
    int passes = 0;                   ///< over all pairs; of several solves, of all of them
    std::int64_t working_pairs = 0;   ///< pairs that the last working set held, all ranks
    std::int64_t nonzero_groups = 0;  ///< pairs with a value > 0, all ranks
    StopReason reason = StopReason::gap_reached;
    /// One row for each pass over all pairs (dense solver: for each certificate); the last row has the
    /// figures above. In mesh scope and for ssc, row k is the state after every column's k-th pass. The
    /// history is complete also where a checkpoint resumes the solve.
    SolveHistory history;
    static constexpr auto fields() {
        return std::tuple(field("objective", &SolveSummary::objective),
                          field("objective_at_zero", &SolveSummary::objective_at_zero),
                          field("lower_bound", &SolveSummary::lower_bound),
                          field("relative_gap", &SolveSummary::relative_gap),
                          field("kkt_residual", &SolveSummary::kkt_residual),
                          field("iterations", &SolveSummary::iterations),
                          field("passes", &SolveSummary::passes),
                          field("working_pairs", &SolveSummary::working_pairs),
                          field("nonzero_groups", &SolveSummary::nonzero_groups),
                          field("reason", &SolveSummary::reason), field("history", &SolveSummary::history));
    }
};

/// `width`, the distance between an objective and its lower bound, over `scale`; never below 0. Where the
/// scale is 0, it is 0 if the width is rounding beside the objective at W = 0, and else 1.
double relative_gap(double width, double scale, double objective_at_zero);

/// Adds up solves that are independent of each other: bounds and counts are sums; residual, iterations and
/// reason are those of the worst. Leaves the relative gap and the history to the caller.
void add_certificate(SolveSummary& sum, const SolveSummary& one);

}  // namespace coseg
