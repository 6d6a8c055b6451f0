#pragma once
// A span of a rank's time, as a trace viewer draws it.

#include <string>
#include <tuple>
#include <vector>

#include "src/records/fields.hpp"

namespace coseg {

struct TraceEvent {
    std::string name;
    std::string category;  ///< stage, mesh, step or wait
    double start = 0.0;    ///< seconds since the ranks started together
    double seconds = 0.0;  ///< >= 0
    static constexpr auto fields() {
        return std::tuple(field("name", &TraceEvent::name), field("category", &TraceEvent::category),
                          field("start", &TraceEvent::start), field("seconds", &TraceEvent::seconds));
    }
};

/// The spans of one rank, in the order in which they ended.
using RankTrace = std::vector<TraceEvent>;

}  // namespace coseg
