#pragma once
// Initialises MPI, quickly where a process works alone.

namespace coseg {

/// MPI_Init_thread. Beside a process that no launcher has started Open MPI starts a daemon, so that the
/// process could spawn others, and this takes as long as all else of the start; and it makes a folder for the
/// files that processes share, which other processes of the same user remove when they end. None of ours ever
/// spawns or shares, so both are left out. The environment is afterwards as it was, and what it says of
/// OMPI_MCA_ess_singleton_isolated and OMPI_MCA_orte_create_session_dirs is heeded. `thread_level`:
/// MPI_THREAD_FUNNELED or another.
void initialise_mpi(int thread_level);

}  // namespace coseg
