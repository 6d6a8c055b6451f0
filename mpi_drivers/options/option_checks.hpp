#pragma once
// Checks of option values that CLI11 leaves to its users.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace coseg {

/// Refuses values that are not finite; CLI::Range lets NaN pass.
inline const CLI::Validator finite_number(
    [](std::string& text) {
        double value = 0.0;
        if (CLI::detail::lexical_cast(text, value) && !std::isfinite(value)) return text + " is not finite";
        return std::string();
    },
    "");

/// To be given to transform() of every option that takes a whole number: CLI11 would take 010 for 8 and 0x10
/// for 16. Zeros before other digits do not count, as in files (whole_number in src/base/text.hpp).
inline const CLI::Validator decimal_digits(
    [](std::string& text) {
        const std::size_t sign = text.starts_with("-") ? 1 : 0;
        const std::string_view digits = std::string_view(text).substr(sign);
        const bool is_number = !digits.empty() && std::all_of(digits.begin(), digits.end(),
                                                              [](char c) { return c >= '0' && c <= '9'; });
        if (!is_number) return "'" + text + "' is no whole number; write it in digits";
        text.erase(sign, std::min(text.find_first_not_of('0', sign), text.size() - 1) - sign);
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

/// Of the files that a command is to write: options with their paths, "" where an option is not given. Throws
/// Error(usage) where one is an input, as above, or two are the same file, under whatever names, and
/// Error(output) where one cannot be written. To be called before the work.
void check_output_files(const std::vector<std::pair<std::string, std::string>>& outputs,
                        const std::vector<std::string>& inputs);

/// Throws Error(output) where a folder of this path can neither be there nor be made, as far as names and
/// permissions tell. Makes nothing, so that a command may ask before its work.
void check_output_folder(const std::string& folder);

}  // namespace coseg
