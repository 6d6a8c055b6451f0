#include "solvers/subspace/solve_result.hpp"

namespace coseg {

std::string to_string(StopReason reason) {
    switch (reason) {
        case StopReason::gap_reached:
            return "gap_reached";
        case StopReason::residual_reached:
            return "residual_reached";
        case StopReason::iteration_limit:
            return "iteration_limit";
        case StopReason::time_limit:
            return "time_limit";
    }
    return "unknown";
}

}  // namespace coseg
