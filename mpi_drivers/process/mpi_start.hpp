#pragma once
// Prepares the process for MPI, and initialises MPI, quickly where a process works alone.

namespace coseg {

/// Raises a small limit of the stack (ulimit -s) to the 8 MiB that systems give otherwise, for this process
/// and for those that it starts: Open MPI, and mpirun, end with a segmentation fault on less than some 256
/// KiB. Where the limit may not be raised so far and is below 512 KiB, ends the process with a sentence.
void raise_stack_limit();

/// MPI_Init_thread. Beside a process that no launcher has started Open MPI starts a daemon, so that the
/// process could spawn others, and this takes as long as all else of the start; and it makes a folder for the
/// files that processes share, which other processes of the same user remove when they end. None of ours ever
/// spawns or shares, so both are left out. The environment is afterwards as it was, and what it says of
/// OMPI_MCA_ess_singleton_isolated and OMPI_MCA_orte_create_session_dirs is heeded. `thread_level`:
/// MPI_THREAD_FUNNELED or another.
void initialise_mpi(int thread_level);

}  // namespace coseg
