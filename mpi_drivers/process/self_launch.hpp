#pragma once
// A run that was started without mpirun starts itself again with it, one rank a core.

namespace coseg {

/// Before MPI is initialised. Replaces this process by `mpirun -n RANKS` of the same command line if
/// - the command is one that divides its work over ranks (run),
/// - it was started neither by mpirun nor by srun nor by another launcher that MPI knows of,
/// - and RANKS, that is `--ranks`, or else the environment variable COSEG_RANKS, or else the number of cores that this
///   process may use, is more than one.
/// Otherwise, and if there is no mpirun, returns and the command runs on one rank. What is not a number of ranks is
/// left to the command line's own check. The results have the same bytes either way.
void launch_on_all_cores(int argc, char** argv);

}  // namespace coseg
