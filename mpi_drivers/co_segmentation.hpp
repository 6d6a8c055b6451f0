#pragma once
// The pipeline of `coseg run`: from a list of meshes to one consistent segmentation, stage by stage.

#include <string>
#include <vector>

#include "mpi_drivers/options/run_options.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

/// Runs all stages and writes the folder options.output.folder. petsc_arguments: what follows `--` on the
/// command line. Collective; throws AgreedError: not_converged also after all is written, where a limit ended
/// the optimiser before its gap.
void co_segment(const Comm& comm, const RunOptions& options,
                const std::vector<std::string>& petsc_arguments = {});

}  // namespace coseg
