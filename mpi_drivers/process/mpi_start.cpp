#include "mpi_drivers/process/mpi_start.hpp"

#include <mpi.h>

#include <array>
#include <cstdlib>
#include <vector>

#include "mpi_drivers/process/environment_setting.hpp"
#include "mpi_drivers/process/self_launch.hpp"

namespace coseg {

namespace {

/// Of Open MPI, for a process that no launcher has started. Its folder of the session would have the same
/// name for all such processes of a user, and one that ends removes it from under one that starts.
constexpr std::array<EnvironmentSetting, 2> alone{
    {{"OMPI_MCA_ess_singleton_isolated", "1"}, {"OMPI_MCA_orte_create_session_dirs", "0"}}};

/// What Open MPI tells itself of such a process through its environment. A program that the process starts
/// would take it for its own: mpirun then ends without a word.
constexpr std::array<const char*, 6> told_by_mpi{"OMPI_MCA_ess",
                                                 "OMPI_MCA_pmix",
                                                 "OMPI_MCA_orte_ess_num_procs",
                                                 "OMPI_MCA_orte_precondition_transports",
                                                 "OMPI_APP_CTX_NUM_PROCS",
                                                 "ORTE_SCHIZO_DETECTION"};

}  // namespace

void initialise_mpi(int thread_level) {
    std::vector<const char*> ours;
    for (const EnvironmentSetting& setting : alone) {
        if (is_launched() || is_set(setting.variable)) continue;
        ::setenv(setting.variable, setting.value, 1);
        ours.push_back(setting.variable);
    }
    for (const char* variable : told_by_mpi) {
        if (!is_set(variable)) ours.push_back(variable);
    }
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, thread_level, &provided);
    for (const char* variable : ours) ::unsetenv(variable);
}

}  // namespace coseg
