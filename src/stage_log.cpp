#include "src/stage_log.hpp"

#include <unistd.h>

#include <cstdio>
#include <utility>

namespace coseg {

StageLog::StageLog(const Comm& comm, Verbosity verbosity)
    : comm_(comm), verbosity_(verbosity), is_terminal_(isatty(STDERR_FILENO) != 0) {}

void StageLog::begin(const std::string& stage) {
    stage_ = stage;
    stage_start_ = Clock::now();
    own_seconds_ = -1.0;
    steps_.clear();
}

void StageLog::progress(std::int64_t done, std::int64_t total) {
    if (!comm_.is_root() || !is_terminal_ || verbosity_ == Verbosity::quiet || total <= 0) return;
    constexpr int width = 30;
    const int filled = static_cast<int>(width * done / total);
    std::fprintf(stderr, "\r%-14s [%-*.*s] %lld/%lld", stage_.c_str(), width, filled,
                 "##############################", static_cast<long long>(done),
                 static_cast<long long>(total));
    std::fflush(stderr);
    bar_shown_ = true;
}

void StageLog::clear_bar() {
    if (bar_shown_) std::fputs("\r\033[K", stderr);
    bar_shown_ = false;
}

void StageLog::end_of_own_work() {
    own_seconds_ = std::chrono::duration<double>(Clock::now() - stage_start_).count();
}

void StageLog::step(const std::string& name, double seconds) { steps_.push_back({name, seconds}); }

void StageLog::end(const std::string& summary) {
    if (own_seconds_ < 0.0) end_of_own_work();
    StageTimes times;
    times.stage = stage_;
    times.seconds_min = all_min(comm_, own_seconds_);
    times.seconds_max = all_max(comm_, own_seconds_);
    double total = 0.0;
    MPI_Allreduce(&own_seconds_, &total, 1, MPI_DOUBLE, MPI_SUM, comm_.raw());
    times.seconds_mean = total / comm_.size();
    times.seconds_wall = std::chrono::duration<double>(Clock::now() - stage_start_).count();
    times.steps = std::move(steps_);
    for (StepTime& step : times.steps)
        MPI_Allreduce(MPI_IN_PLACE, &step.seconds, 1, MPI_DOUBLE, MPI_SUM, comm_.raw());
    stages_.push_back(times);
    if (!comm_.is_root() || verbosity_ == Verbosity::quiet) return;
    clear_bar();
    std::fprintf(stderr, "%-14s %7.2f s  %s\n", stage_.c_str(), times.seconds_wall, summary.c_str());
    std::fflush(stderr);
}

void StageLog::warn(const std::string& sentence) const {
    if (comm_.is_root()) std::fprintf(stderr, "coseg: warning: %s\n", sentence.c_str());
}

double StageLog::seconds_since_start() const {
    return std::chrono::duration<double>(Clock::now() - start_).count();
}

}  // namespace coseg
