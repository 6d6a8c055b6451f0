// `coseg man` and `coseg completion`: the manual page and the shell's completion, made from the options that
// are declared.

#include <CLI/CLI.hpp>
#include <iostream>
#include <string>
#include <vector>

#include "mpi_drivers/options/command.hpp"
#include "mpi_drivers/options/help_pages.hpp"
#include "src/families/shape_families.hpp"

namespace coseg {

namespace {

std::vector<std::string> family_names() {
    std::vector<std::string> names;
    for (const ShapeFamily& family : shape_families()) names.push_back(family.name);
    return names;
}

}  // namespace

Command add_man_command(CLI::App& parent) {
    CLI::App* app = parent.add_subcommand("man", "Print the manual page: coseg man | man -l -");
    return {app, [&parent](const Invocation& invocation) {
                if (invocation.world.is_root()) std::cout << man_page(parent);
            }};
}

Command add_completion_command(CLI::App& parent) {
    CLI::App* app =
        parent.add_subcommand("completion", "Print completion for bash: source <(coseg completion)");
    return {app, [&parent](const Invocation& invocation) {
                if (invocation.world.is_root()) std::cout << bash_completion(parent, family_names());
            }};
}

}  // namespace coseg
