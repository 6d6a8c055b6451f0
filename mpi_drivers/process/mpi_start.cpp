#include "mpi_drivers/process/mpi_start.hpp"

#include <mpi.h>

#include <cstdlib>

namespace coseg {

void initialise_mpi(int thread_level) {
    const char* const variable = "OMPI_MCA_ess_singleton_isolated";
    const bool is_set = std::getenv(variable) != nullptr;
    if (!is_set) ::setenv(variable, "1", 1);
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, thread_level, &provided);
    if (!is_set) ::unsetenv(variable);
}

}  // namespace coseg
