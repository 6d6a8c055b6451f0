#pragma once
// Lets a run that was started without mpirun start itself again with it, with one rank a core.

#include <string>

namespace coseg {

/// Whether mpirun, srun or another launcher that MPI knows of has started this process.
bool is_launched();

/// Call this before MPI is initialised. It runs `mpirun -n RANKS` with the same command line in place of this
/// process, which hands signals on to it and ends as it does, if
/// - the command is one that divides its work over ranks (run),
/// - it was started neither by mpirun nor by srun nor by another launcher that MPI knows of,
/// - and RANKS is more than one. RANKS is `--ranks`, or else the environment variable COSEG_RANKS, or else
///   the number of cores that this process may use.
/// SIGTERM is handed on as SIGUSR1 where the command line has --state: the ranks then write their state, and
/// the process ends with 75.
///
/// Otherwise, and if there is no mpirun, the function returns and the command runs on one rank. A value of
/// --ranks that is no number of ranks up to most_ranks_of_a_launch is left to the command line's own check;
/// one of COSEG_RANKS ends the process with a sentence and exit code 2. The results have the same bytes in
/// both cases.
void launch_on_all_cores(int argc, char** argv);

/// The argument "@/dev/fd/N" for a list of meshes that the shell hands over as an open pipe, as in
/// @<(find ...), in the form in which a rank can open it where mpirun has kept the pipe for itself; any other
/// argument as it is.
std::string reachable_list(const std::string& argument);

}  // namespace coseg
