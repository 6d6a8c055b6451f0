#pragma once
// The stages of `coseg assign`: new shapes labelled like those of a finished run, without solving it again.

#include <string>
#include <vector>

#include "mpi_drivers/options/run_options.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

/// Labels the meshes own.process.inputs as the run in the folder `run` labels its own, and writes
/// own.output.folder. All other options are the run's. petsc_arguments: what follows `--` on the command
/// line. Collective; throws AgreedError: not_converged also after all is written, where a limit ended a solve
/// before its gap.
void assign(const Comm& comm, const std::string& run, const RunOptions& own,
            const std::vector<std::string>& petsc_arguments = {});

}  // namespace coseg
