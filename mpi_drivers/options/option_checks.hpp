#pragma once
// Checks of option values that CLI11 leaves to its users.

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>
#include <string_view>
#include <utility>

namespace coseg {

/// Refuses values that are not finite; CLI::Range lets NaN pass.
inline const CLI::Validator finite_number(
    [](std::string& text) {
        double value = 0.0;
        if (CLI::detail::lexical_cast(text, value) && !std::isfinite(value)) return text + " is not finite";
        return std::string();
    },
    "");

/// CLI11 takes the nearest number of 64 bits for one beyond them.
inline const CLI::Validator unsigned_number(
    [](std::string& text) {
        if (text.starts_with("-")) return text + " is negative";
        errno = 0;
        std::strtoull(text.c_str(), nullptr, 0);
        return errno == ERANGE ? text + " is more than 18446744073709551615" : std::string();
    },
    "");

/// A relative gap that sums in double precision can reach, from `least` to 1. CLI::Range would print the
/// limit as 0.
CLI::Validator gap_from(double least);

/// Throws Error(usage) where the file that `option` names for the output is one of the inputs, under whatever
/// name. "" and what is no regular file are no output to lose an input by; an @LIST counts as its file.
void refuse_output_over_input(const std::string& option, const std::string& output,
                              const std::vector<std::string>& inputs);

}  // namespace coseg
/// Of the files that a command is to write: options with their paths, "" where an option is not given. Throws
/// Error(usage) where one is an input, as above, or two are the same file, under whatever names, and
/// Error(output) where one cannot be written. To be called before the work.
void check_output_files(const std::vector<std::pair<std::string, std::string>>& outputs,
                        const std::vector<std::string>& inputs);

/// Throws Error(output) where a folder of this path can neither be there nor be made, as far as names and
/// permissions tell. Makes nothing, so that a command may ask before its work.
void check_output_folder(const std::string& folder);

