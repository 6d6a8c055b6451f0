#include "mpi_drivers/process/self_launch.hpp"

#include <fcntl.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "mpi_drivers/process/environment_setting.hpp"
#include "src/base/error.hpp"
#include "src/base/text.hpp"
#include "src/parallel/launch_request.hpp"

namespace coseg {

namespace {

constexpr std::array<const char*, 6> marks_of_launchers{
    "OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK", "PMI_SIZE", "SLURM_STEPID", "ALPS_APP_PE"};

int usable_cores() {
    cpu_set_t cores;
    CPU_ZERO(&cores);
    return sched_getaffinity(0, sizeof cores, &cores) == 0 ? CPU_COUNT(&cores) : 1;
}

int ranks_of_variable(const std::string& text) {
    const std::optional<int> ranks = whole_number(text);
    if (ranks && *ranks >= 0 && *ranks <= most_ranks_of_a_launch)
        return *ranks == 0 ? usable_cores() : *ranks;
    std::fprintf(stderr, "coseg: COSEG_RANKS: '%s' is no number of ranks from 0 to %d\n", text.c_str(),
                 most_ranks_of_a_launch);
    std::exit(static_cast<int>(ExitCode::usage));
}

int wanted_ranks(std::optional<int> asked) {
    if (asked) return *asked == 0 ? usable_cores() : *asked;
    if (const char* variable = std::getenv("COSEG_RANKS")) return ranks_of_variable(variable);
    return usable_cores();
}

/// Who is root has decided so already, and mpirun itself looks for programs on PATH.
constexpr std::array<EnvironmentSetting, 3> needed{{{"PATH", "/usr/local/bin:/usr/bin:/bin"},
                                                    {"OMPI_ALLOW_RUN_AS_ROOT", "1"},
                                                    {"OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1"}}};

/// On one machine Open MPI needs no libraries of fast networks, each of which watches the clock for a while
/// at every start, and hwloc need not look for graphics cards and devices.
constexpr std::array<EnvironmentSetting, 2> on_one_machine{
    {{"OMPI_MCA_pml", "ob1"}, {"HWLOC_COMPONENTS", "-gl,-opencl,-pci,-linuxio"}}};

/// Of batch systems whose machines mpirun uses without being told.
constexpr std::array<const char*, 4> marks_of_allocations{"SLURM_JOB_ID", "PBS_JOBID", "LSB_JOBID",
                                                          "PE_HOSTFILE"};

/// What the user has set stays.
void prepare_environment() {
    for (const EnvironmentSetting& setting : needed) setenv(setting.variable, setting.value, 0);
    if (std::any_of(marks_of_allocations.begin(), marks_of_allocations.end(), is_set)) return;
    for (const EnvironmentSetting& setting : on_one_machine) setenv(setting.variable, setting.value, 0);
}

/// The process that works in place of this one, and whether its ranks keep a state that they can write.
volatile pid_t worker = 0;
volatile bool worker_keeps_state = false;

/// The signal by which this process was asked to end, 0 before.
volatile std::sig_atomic_t asked_to_end = 0;

/// mpirun that is terminated ends with 1 at once, whatever its ranks say. Ranks that keep a state are asked
/// to write it, by the signal that mpirun hands on to them.
void send_to_worker(int signal) {
    if (worker > 0) ::kill(worker, signal == SIGTERM && worker_keeps_state ? SIGUSR1 : signal);
}

void hand_on_signal(int signal) {
    if (signal == SIGTERM || signal == SIGHUP) asked_to_end = signal;
    send_to_worker(signal);
}

/// A terminal's interrupt reaches mpirun too, and of a second one it would leave its ranks behind. One that
/// was meant for this process alone is handed on when the worker should have ended by itself.
void heed_interrupt(int signal, siginfo_t* cause, void* /*context*/) {
    constexpr unsigned grace = 3;  // seconds; mpirun ends its ranks within about one
    asked_to_end = signal;
    if (cause->si_code != SI_KERNEL) alarm(grace);
}

void end_worker(int /*signal*/) { send_to_worker(SIGTERM); }

/// An interrupt that is ignored, as in the background of a script, stays so.
void set_interrupt_handlers() {
    if (std::signal(SIGINT, SIG_IGN) == SIG_IGN) return;
    std::signal(SIGALRM, end_worker);
    struct sigaction action {};
    action.sa_sigaction = heed_interrupt;
    action.sa_flags = SA_SIGINFO | SA_RESTART;
    sigaction(SIGINT, &action, nullptr);
}

/// In the child: becomes the program, and ends with the parent whatever ends that. Where there is no such
/// program, the pipe tells so.
[[noreturn]] void become(const std::vector<char*>& line, pid_t parent, int failed) {
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (getppid() != parent) _exit(1);
    execvp(line.front(), line.data());
    const char mark = 1;
    [[maybe_unused]] const ssize_t told = write(failed, &mark, 1);
    _exit(1);
}

[[noreturn]] void end_by(int signal) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
    _exit(128 + signal);
}

/// Ends as the worker has ended. mpirun that was ended by a signal says 1, which is for defects.
[[noreturn]] void end_like(int status) {
    if (!WIFEXITED(status)) end_by(WTERMSIG(status));
    if (asked_to_end != 0 && WEXITSTATUS(status) == 1) end_by(asked_to_end);
    _exit(WEXITSTATUS(status));
}

/// Runs a program in place of this one, to which signals are handed on.
/// Returns only where there is no such program.
void run_instead(const std::vector<char*>& line, bool keeps_state) {
    std::array<int, 2> failed{};
    if (pipe2(failed.data(), O_CLOEXEC) != 0) return;
    worker_keeps_state = keeps_state;
    const pid_t self = getpid();
    worker = fork();
    if (worker == 0) become(line, self, failed[1]);
    close(failed[1]);
    if (worker < 0) return;
    constexpr std::array<int, 4> handed_on{SIGTERM, SIGHUP, SIGUSR1, SIGUSR2};
    for (const int signal : handed_on) {
        if (std::signal(signal, hand_on_signal) == SIG_IGN) std::signal(signal, SIG_IGN);  // as nohup has it
    }
    set_interrupt_handlers();
    int status = 0;
    while (waitpid(worker, &status, 0) < 0 && errno == EINTR) {
    }
    char mark = 0;
    if (read(failed[0], &mark, 1) != 1) end_like(status);
    close(failed[0]);
    worker = 0;
    for (const int signal : handed_on) std::signal(signal, SIG_DFL);
    std::signal(SIGINT, SIG_DFL);
}

}  // namespace

bool is_launched() { return std::any_of(marks_of_launchers.begin(), marks_of_launchers.end(), is_set); }

void launch_ranks(const LaunchRequest& request, int argc, char** argv) {
    const int ranks = wanted_ranks(request.ranks);
    if (ranks < 2) return;
    std::array<char, 4096> self{};
    if (readlink("/proc/self/exe", self.data(), self.size() - 1) <= 0) return;
    std::vector<std::string> line = {COSEG_MPIEXEC, "--quiet", "--oversubscribe",     "--bind-to",
                                     "none",        "-n",      std::to_string(ranks), self.data()};
    line.insert(line.end(), argv + std::min(argc, 1), argv + argc);
    std::vector<char*> pointers;
    for (std::string& word : line) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    prepare_environment();
    run_instead(pointers, request.keeps_state);
}

std::string reachable_list(const std::string& argument) {
    constexpr std::string_view open_file = "@/dev/fd/";
    if (!argument.starts_with(open_file)) return argument;
    std::error_code ignored;
    if (std::filesystem::exists(argument.substr(1), ignored)) return argument;
    // mpirun, the parent of a rank on its machine, closes for the ranks what it does not know.
    std::string kept = "@/proc/" + std::to_string(getppid()) + "/fd/" + argument.substr(open_file.size());
    return std::filesystem::exists(kept.substr(1), ignored) ? kept : argument;
}

}  // namespace coseg
