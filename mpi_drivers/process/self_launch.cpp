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

#include "src/base/error.hpp"
#include "src/base/text.hpp"
#include "src/parallel/rank_limit.hpp"

namespace coseg {

namespace {

constexpr std::array<const char*, 6> marks_of_launchers{
    "OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK", "PMI_SIZE", "SLURM_STEPID", "ALPS_APP_PE"};
constexpr std::array<std::string_view, 3> commands_in_parallel{"run", "assign", "edit"};

/// Of what stands before `--`; the last one counts, as for every option.
std::optional<std::string_view> ranks_option(const std::vector<std::string_view>& words) {
    constexpr std::string_view name = "--ranks";
    std::optional<std::string_view> value;
    for (std::size_t i = 0; i < words.size() && words[i] != "--"; ++i) {
        if (words[i] == name && i + 1 < words.size()) value = words[i + 1];
        if (words[i].starts_with("--ranks=")) value = words[i].substr(name.size() + 1);
    }
    return value;
}

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

int wanted_ranks(const std::vector<std::string_view>& words) {
    if (const auto option = ranks_option(words)) return whole_number(*option).value_or(1);
    if (const char* variable = std::getenv("COSEG_RANKS")) return ranks_of_variable(variable);
    return usable_cores();
}

bool asks_for_help(const std::vector<std::string_view>& words) {
    return std::any_of(words.begin(), words.end(),
                       [](std::string_view w) { return w == "--help" || w == "-h"; });
}

/// On one machine: more ranks than Open MPI counts cores are fine, none is tied to a core that another
/// program uses, and who is root has decided so already. mpirun itself looks for programs on PATH.
void prepare_environment() {
    setenv("PATH", "/usr/local/bin:/usr/bin:/bin", 0);
    setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 0);
    setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 0);
}

/// The process that works in place of this one, and whether its ranks keep a state that they can write.
volatile pid_t worker = 0;
volatile bool worker_keeps_state = false;

/// mpirun that is terminated ends with 1 at once, whatever its ranks say. Ranks that keep a state are asked
/// to write it, by the signal that mpirun hands on to them.
void hand_on_signal(int signal) {
    if (worker > 0) ::kill(worker, signal == SIGTERM && worker_keeps_state ? SIGUSR1 : signal);
}

bool has_state_option(const std::vector<std::string_view>& words) {
    return std::any_of(words.begin(), words.end(), [](std::string_view word) {
        return word == "--state" || word.starts_with("--state=");
    });
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

/// Ends as the worker has ended.
[[noreturn]] void end_like(int status) {
    if (WIFEXITED(status)) _exit(WEXITSTATUS(status));
    std::signal(WTERMSIG(status), SIG_DFL);
    std::raise(WTERMSIG(status));
    _exit(128 + WTERMSIG(status));
}

/// Runs a program in place of this one. A terminal's interrupt reaches both; other signals are handed on.
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
    std::signal(SIGINT, SIG_IGN);
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

bool is_launched() {
    return std::any_of(marks_of_launchers.begin(), marks_of_launchers.end(),
                       [](const char* name) { return std::getenv(name) != nullptr; });
}

void launch_on_all_cores(int argc, char** argv) {
    const std::vector<std::string_view> words(argv + std::min(argc, 1), argv + argc);
    const bool is_parallel =
        !words.empty() && std::find(commands_in_parallel.begin(), commands_in_parallel.end(),
                                    words.front()) != commands_in_parallel.end();
    if (!is_parallel || is_launched() || asks_for_help(words)) return;
    const int ranks = wanted_ranks(words);
    if (ranks < 2 || ranks > most_ranks_of_a_launch) return;
    std::array<char, 4096> self{};
    if (readlink("/proc/self/exe", self.data(), self.size() - 1) <= 0) return;
    std::vector<std::string> line = {COSEG_MPIEXEC, "--quiet", "--oversubscribe",     "--bind-to",
                                     "none",        "-n",      std::to_string(ranks), self.data()};
    line.insert(line.end(), words.begin(), words.end());
    std::vector<char*> pointers;
    for (std::string& word : line) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    prepare_environment();
    run_instead(pointers, has_state_option(words));
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
