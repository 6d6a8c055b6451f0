#pragma once
// Options of a run by their names, for those who have no command line.

#include <string>
#include <utility>
#include <vector>

#include "mpi_drivers/options/option_value.hpp"
#include "mpi_drivers/options/run_options.hpp"

namespace coseg {

/// An option's name without its dashes, and its value as it stands on the command line; "true" or "false" for
/// a switch.
using NamedOption = std::pair<std::string, std::string>;

/// The options of `coseg run` with these values, checked like those of the command line; the order does not
/// matter, except that values count more than what a preset stands for. Options of input, output and of what
/// is printed are not among the names. Throws Error(usage) for a name that is none, with the one that was
/// probably meant, and for a value that the option does not take.
RunOptions options_by_name(const std::vector<NamedOption>& given);

/// Every option of `coseg run` as `options` has it.
std::vector<OptionValue> option_values(RunOptions options);

/// The names that options_by_name takes.
std::vector<std::string> named_option_names();

/// What each of them takes, in the same order.
std::vector<OptionKind> named_option_kinds();

}  // namespace coseg
