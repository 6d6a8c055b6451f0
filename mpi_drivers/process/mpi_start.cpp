#include "mpi_drivers/process/mpi_start.hpp"

#include <mpi.h>

#include <array>
#include <cstdlib>
#include <vector>

#include "mpi_drivers/process/self_launch.hpp"

namespace coseg {

namespace {

struct Setting {
    const char* variable;
    const char* value;
};

/// Of Open MPI, for a process that no launcher has started. Its folder of the session would have the same
/// name for all such processes of a user, and one that ends removes it from under one that starts.
constexpr std::array<Setting, 2> alone{
    {{"OMPI_MCA_ess_singleton_isolated", "1"}, {"OMPI_MCA_orte_create_session_dirs", "0"}}};

}  // namespace

void initialise_mpi(int thread_level) {
    std::vector<const char*> ours;
    for (const Setting& setting : alone) {
        if (is_launched() || std::getenv(setting.variable) != nullptr) continue;
        ::setenv(setting.variable, setting.value, 1);
        ours.push_back(setting.variable);
    }
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, thread_level, &provided);
    for (const char* variable : ours) ::unsetenv(variable);
}

}  // namespace coseg
