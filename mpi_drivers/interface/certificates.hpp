#pragma once
// The certificate of the interface.

#include <coseg/coseg.hpp>

#include "src/records/solve_summary.hpp"

namespace coseg {

/// What a solve says of itself; `reached` where its gap is the one that was asked for.
Certificate certificate_of(const SolveSummary& solution);

}  // namespace coseg
