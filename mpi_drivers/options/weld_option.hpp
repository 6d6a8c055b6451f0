#pragma once
// Adds --weld, which a run and `coseg check` have.

#include <CLI/CLI.hpp>

#include "mpi_drivers/options/stage_options.hpp"

namespace coseg {

inline constexpr const char* weld_help =
    "Borders of a mesh that nearly touch are joined: auto (where they are as near as rounding leaves them), "
    "exact (only where their coordinates are equal), or within this share of the mesh's size, up to 0.01";

CLI::Option* add_weld_option(CLI::App& app, WeldChoice& variable);

}  // namespace coseg
