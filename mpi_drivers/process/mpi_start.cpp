#include "mpi_drivers/process/mpi_start.hpp"

#include <mpi.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "mpi_drivers/process/environment_setting.hpp"
#include "mpi_drivers/process/self_launch.hpp"
#include "src/base/error.hpp"

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

void raise_stack_limit() {
    constexpr rlim_t usual = rlim_t{8} << 20U;
    constexpr rlim_t least = rlim_t{512} << 10U;
    rlimit limit{};
    if (getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur >= usual) return;  // RLIM_INFINITY is largest
    const rlimit asked{usual, std::max(usual, limit.rlim_max)};
    if (setrlimit(RLIMIT_STACK, &asked) == 0) return;  // a hard limit below this is raised for root alone
    const rlimit most{limit.rlim_max, limit.rlim_max};
    if (limit.rlim_max > limit.rlim_cur && setrlimit(RLIMIT_STACK, &most) == 0) limit = most;
    if (limit.rlim_cur >= least) return;
    std::fprintf(stderr,
                 "coseg: the stack is limited to %llu KiB, and MPI needs 512; raise it with ulimit -s\n",
                 static_cast<unsigned long long>(limit.rlim_cur >> 10U));
    std::exit(static_cast<int>(ExitCode::usage));
}

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
