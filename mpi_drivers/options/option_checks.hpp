#pragma once
// Checks of option values that CLI11 leaves to its users.

#include <CLI/CLI.hpp>
#include <cmath>
#include <string>

namespace coseg {

/// Refuses values that are not finite; CLI::Range lets NaN pass.
inline const CLI::Validator finite_number(
    [](std::string& text) {
        double value = 0.0;
        if (CLI::detail::lexical_cast(text, value) && !std::isfinite(value)) return text + " is not finite";
        return std::string();
    },
    "");

}  // namespace coseg
