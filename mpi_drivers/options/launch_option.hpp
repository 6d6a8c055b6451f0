#pragma once
// The option of commands that divide their work over ranks, and start these themselves without mpirun.

#include <CLI/CLI.hpp>
#include <optional>

#include "src/parallel/launch_request.hpp"

namespace coseg {

/// Adds --ranks, which launch_request reads. It serves before MPI starts, and nothing afterwards.
CLI::Option* add_ranks_option(CLI::App& command);

/// What the options of a parsed command come to; nothing for a command without --ranks.
std::optional<LaunchRequest> launch_request(const CLI::App& command);

}  // namespace coseg
