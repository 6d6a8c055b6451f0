#include "mpi_drivers/interface/certificates.hpp"

namespace coseg {

Certificate certificate_of(const SolveSummary& solution) {
    return {.objective = solution.objective,
            .lower_bound = solution.lower_bound,
            .relative_gap = solution.relative_gap,
            .reached = solution.reason == StopReason::gap_reached,
            .reason = to_string(solution.reason),
            .iterations = solution.iterations,
            .nonzero_pairs = solution.nonzero_groups};
}

}  // namespace coseg
