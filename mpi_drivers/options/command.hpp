#pragma once
// A subcommand of coseg: a set of options that is added to the command line, and a function to run.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "src/parallel/comm.hpp"

namespace CLI {
class App;
}

namespace coseg {

/// What the command line gives besides the subcommand's own options.
struct Invocation {
    const Comm& world;
    std::vector<std::string> petsc_arguments;  ///< whatever follows `--`
};

struct Command {
    CLI::App* app = nullptr;  ///< parsed() tells whether the user asked for it
    /// Throws Error; AgreedError where all ranks agree.
    std::function<void(const Invocation& invocation)> run;
};

/// Each function adds its subcommand to `parent`. CLI11 validates the options (type, range) before run is
/// called.
Command add_run_command(CLI::App& parent);
Command add_check_command(CLI::App& parent);
Command add_generate_command(CLI::App& parent);
Command add_score_command(CLI::App& parent);
Command add_solve_command(CLI::App& parent);
Command add_render_command(CLI::App& parent);
Command add_cluster_command(CLI::App& parent);
Command add_report_command(CLI::App& parent);
Command add_export_command(CLI::App& parent);
Command add_man_command(CLI::App& parent);
Command add_completion_command(CLI::App& parent);
Command add_describe_command(CLI::App& parent);
Command add_state_command(CLI::App& parent);
Command add_assign_command(CLI::App& parent);
Command add_edit_command(CLI::App& parent);

}  // namespace coseg
