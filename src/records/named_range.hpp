#pragma once
// The range over which a feature is binned, as reports have it.

#include <string>
#include <tuple>

#include "src/records/fields.hpp"

namespace coseg {

struct NamedRange {
    std::string feature;
    std::string kind;  ///< how the range is found, in words
    double low = 0.0;
    double high = 0.0;
    static constexpr auto fields() {
        return std::tuple(field("feature", &NamedRange::feature), field("kind", &NamedRange::kind),
                          field("low", &NamedRange::low), field("high", &NamedRange::high));
    }
};

}  // namespace coseg
