#pragma once
// Reads options from a TOML or INI file, as if they stood on the command line.

#include <functional>
#include <string>
#include <vector>

#include "src/parallel/comm.hpp"

namespace coseg {

/// Of an option, with its dashes, that a file has.
using OptionTest = std::function<bool(const std::string& option)>;

/// The words of the command line, preceded by the keys of the file that `--config FILE` names, as options. A
/// key is an option's name without its dashes; `input` holds the meshes. Options on the command line itself
/// win, and those that `is_passed_over` are left out. Unknown keys become unknown options, which the parser
/// refuses by name. Without --config the words come back as they are. Needs no MPI. Throws Error(usage) if
/// the file cannot be read or is not TOML or INI.
std::vector<std::string> with_config_file(const std::vector<std::string>& words,
                                          const OptionTest& is_passed_over);

/// The same where rank 0 alone reads the file. Collective; throws AgreedError(usage).
std::vector<std::string> with_config_file(const Comm& comm, const std::vector<std::string>& words,
                                          const OptionTest& is_passed_over);

/// Whether the words have the option, as `--name VALUE` or `--name=VALUE`.
bool is_given(const std::vector<std::string>& words, const std::string& option);

}  // namespace coseg
