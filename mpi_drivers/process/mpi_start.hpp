#pragma once
// Initialises MPI, quickly where a process works alone.

namespace coseg {

/// MPI_Init_thread. Beside a process that no launcher has started Open MPI starts a daemon, so that the
/// process could spawn others, and this takes as long as all else of the start. None of ours ever spawns, so
/// the daemon is left out. The environment is afterwards as it was, and what it says of
/// OMPI_MCA_ess_singleton_isolated is heeded. `thread_level`: MPI_THREAD_FUNNELED or another.
void initialise_mpi(int thread_level);

}  // namespace coseg
