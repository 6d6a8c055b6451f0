#pragma once
// The texts that tell a user of options: --help that fits a screen, the word that a misspelt one was meant to
// be, the manual page, and completion in a shell. All of them come from the options that the commands
// declare.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace coseg {

/// Makes --help show the groups that every user needs and name the others, and --help-all show all. Applies
/// to `app` alone.
void fold_help(CLI::App& app, const std::vector<std::string>& groups_always_shown);

/// Throws CLI::ParseError for the first word that looks like an option and is none of the command's, and
/// names the option that was probably meant; for `--name=` with nothing behind it; and for a file or folder
/// whose name begins with a dash, which has to be written as ./-name. `words` are those of the command,
/// beginning with its name.
void refuse_unknown_options(const CLI::App& command, const std::vector<std::string>& words);

/// Throws CLI::ParseError where an option of the command was given the empty text, as by a variable of the
/// shell that is not set. Call it after parsing.
void refuse_empty_values(const CLI::App& command);

/// A manual page in the language of man(7), section 1.
std::string man_page(const CLI::App& program);

/// A script for bash that completes commands, options, and the families of `coseg generate`.
std::string bash_completion(const CLI::App& program, const std::vector<std::string>& families);

}  // namespace coseg
