#pragma once
// The pipeline of `coseg run`: from a list of meshes to one consistent segmentation, stage by stage.

#include <string>
#include <vector>

#include "mpi_drivers/options/run_options.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

/// Runs all stages and writes the folder of results. petsc_arguments are the words that follow `--` on the
/// command line. Collective. Throws AgreedError. not_converged is thrown also after everything is written,
/// where a limit ended the optimiser before its gap.
void co_segment(const Comm& comm, const RunOptions& given,
                const std::vector<std::string>& petsc_arguments = {});

}  // namespace coseg
