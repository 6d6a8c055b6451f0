#pragma once
// Lets a run that was started without mpirun start itself again with it, with one rank a core.

#include <string>

#include "src/parallel/launch_request.hpp"

namespace coseg {

/// Whether mpirun, srun or another launcher that MPI knows of has started this process.
bool is_launched();

/// Call this before MPI is initialised, in a process that is not launched. It runs `mpirun -n RANKS` with the
/// same command line in place of this process, which hands signals on to it and ends as it does, if RANKS is
/// more than one. RANKS is what the request has, or else the environment variable COSEG_RANKS, or else the
/// number of cores that this process may use. SIGTERM is handed on as SIGUSR1 where the ranks keep a state,
/// which they then write, and the process ends with 75.
///
/// Otherwise, and if there is no mpirun, the function returns and the command runs on one rank, with results
/// of the same bytes. A value of COSEG_RANKS that is no number of ranks ends the process with a sentence and
/// exit code 2.
void launch_ranks(const LaunchRequest& request, int argc, char** argv);

/// The argument "@/dev/fd/N" for a list of meshes that the shell hands over as an open pipe, as in
/// @<(find ...), in the form in which a rank can open it where mpirun has kept the pipe for itself; any other
/// argument as it is.
std::string reachable_list(const std::string& argument);

}  // namespace coseg
