#include "src/parallel/stage_log.hpp"

#include <unistd.h>
#include <algorithm>

#include <cstdio>
#include <utility>

namespace coseg {

namespace {

/// As JSON's strings have it.
std::string json_text(const std::string& text) {
    std::string safe = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') safe += '\\';
        if (static_cast<unsigned char>(c) < 0x20) {
            char code[8];
            std::snprintf(code, sizeof code, "\\u%04x", static_cast<unsigned>(c));
            safe += code;
        } else {
            safe += c;
        }
    }
    return safe + "\"";
}

}  // namespace

StageLog::StageLog(const Comm& comm, Verbosity verbosity, LogForm form)
    : comm_(comm), verbosity_(verbosity), form_(form), is_terminal_(isatty(STDERR_FILENO) != 0) {}

StageLog::StageLog(const Comm& comm, StageListener listener)
    : comm_(comm),
      verbosity_(Verbosity::quiet),
      form_(LogForm::text),
      listener_(std::move(listener)),
      is_terminal_(false) {}

bool StageLog::shows_bar() const {
    return comm_.is_root() && is_terminal_ && verbosity_ != Verbosity::quiet && form_ == LogForm::text;
}

void StageLog::begin(const std::string& stage) {
    stage_ = stage;
    stage_start_ = last_progress_ = Clock::now();
    own_seconds_ = -1.0;
    steps_.clear();
    if (listener_.progress) listener_.progress(stage_, 0, 0);
    if (!shows_bar()) return;
    std::fprintf(stderr, "\r\033[K%-14s ...", stage_.c_str());
    std::fflush(stderr);
    bar_shown_ = true;
}

/// For the log of a job.
void StageLog::print_progress(std::int64_t done, std::int64_t total) {
    constexpr std::chrono::seconds interval{60};
    const Clock::time_point now = Clock::now();
    if (!comm_.is_root() || verbosity_ == Verbosity::quiet || done <= 0 || now - last_progress_ < interval)
        return;
    last_progress_ = now;
    const double so_far = std::chrono::duration<double>(now - stage_start_).count();
    const double left = so_far * static_cast<double>(total - done) / static_cast<double>(done);
    if (form_ == LogForm::json) {
        std::fprintf(stderr,
                     "{\"event\": \"progress\", \"stage\": %s, \"done\": %lld, \"total\": %lld, "
                     "\"seconds_left\": %.0f}\n",
                     json_text(stage_).c_str(), static_cast<long long>(done), static_cast<long long>(total),
                     left);
    } else {
        std::fprintf(stderr, "%-14s %7.2f s  %lld of %lld, about %.0f s left\n", stage_.c_str(), so_far,
                     static_cast<long long>(done), static_cast<long long>(total), left);
    }
    std::fflush(stderr);
}

void StageLog::progress(std::int64_t done, std::int64_t total) {
    if (total <= 0) return;
    if (listener_.progress) listener_.progress(stage_, done, total);
    if (!shows_bar()) return print_progress(done, total);
    constexpr int width = 30;
    const int filled = static_cast<int>(width * done / total);
    std::fprintf(stderr, "\r\033[K%-14s [%-*.*s] %3lld %%  %lld/%lld", stage_.c_str(), width, filled,
                 "##############################", static_cast<long long>(100 * done / total),
                 static_cast<long long>(done), static_cast<long long>(total));
    const double so_far = std::chrono::duration<double>(Clock::now() - stage_start_).count();
    if (done > 0)
        std::fprintf(stderr, "  %.0f s left",
                     so_far * static_cast<double>(total - done) / static_cast<double>(done));
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

void StageLog::step(const std::string& name, double seconds) {
    const auto known =
        std::find_if(steps_.begin(), steps_.end(), [&](const StepTime& step) { return step.step == name; });
    if (known == steps_.end())
        steps_.push_back({name, seconds, seconds, seconds});
    else
        known->seconds += seconds;
}

void StageLog::keep_trace() {
    MPI_Barrier(comm_.raw());
    keeps_trace_ = true;
    trace_start_ = Clock::now();
}

void StageLog::span(const std::string& name, const std::string& category, Clock::time_point start,
                    Clock::time_point end) {
    if (!keeps_trace_) return;
    const auto seconds = [](Clock::duration time) { return std::chrono::duration<double>(time).count(); };
    trace_.push_back({name, category, seconds(start - trace_start_), seconds(end - start)});
}

void StageLog::end(const std::string& summary) {
    const bool has_waited = own_seconds_ >= 0.0;
    if (!has_waited) end_of_own_work();
    StageTimes times;
    times.stage = stage_;
    times.seconds_min = all_min(comm_, own_seconds_);
    times.seconds_max = all_max(comm_, own_seconds_);
    double total = 0.0;
    MPI_Allreduce(&own_seconds_, &total, 1, MPI_DOUBLE, MPI_SUM, comm_.raw());
    times.seconds_mean = total / comm_.size();
    const Clock::time_point now = Clock::now();
    times.seconds_wall = std::chrono::duration<double>(now - stage_start_).count();
    if (has_waited) {
        const std::chrono::duration<double> own(own_seconds_);
        span("waiting", "wait", stage_start_ + std::chrono::duration_cast<Clock::duration>(own), now);
    }
    span(stage_, "stage", stage_start_, now);
    times.steps = std::move(steps_);
    for (StepTime& step : times.steps) {
        step.seconds_min = all_min(comm_, step.seconds);
        step.seconds_max = all_max(comm_, step.seconds);
        MPI_Allreduce(MPI_IN_PLACE, &step.seconds, 1, MPI_DOUBLE, MPI_SUM, comm_.raw());
    }
    stages_.push_back(times);
    if (listener_.progress) listener_.progress(stage_, 1, 1);
    if (!comm_.is_root() || verbosity_ == Verbosity::quiet) return;
    clear_bar();
    print(times, summary);
}

void StageLog::print(const StageTimes& times, const std::string& summary) const {
    if (form_ == LogForm::json) {
        std::string steps;
        for (const StepTime& step : times.steps)
            steps += (steps.empty() ? "" : ", ") + json_text(step.step) + ": " + std::to_string(step.seconds);
        std::fprintf(
            stderr,
            "{\"event\": \"stage\", \"stage\": %s, \"seconds\": %.3f, \"summary\": %s, \"steps\": {%s}}\n",
            json_text(times.stage).c_str(), times.seconds_wall, json_text(summary).c_str(), steps.c_str());
    } else {
        std::fprintf(stderr, "%-14s %7.2f s  %s\n", times.stage.c_str(), times.seconds_wall, summary.c_str());
        for (const StepTime& step : times.steps) {
            if (verbosity_ == Verbosity::verbose)
                std::fprintf(stderr, "  %-16s %7.2f s of all ranks\n", step.step.c_str(), step.seconds);
        }
    }
    std::fflush(stderr);
}

void StageLog::warn(const std::string& sentence) {
    keep_warning(sentence);
    print_warning(sentence);
}

void StageLog::print_warning(const std::string& sentence) const {
    if (listener_.warning) return listener_.warning(sentence);
    if (!comm_.is_root()) return;
    if (form_ == LogForm::json)
        std::fprintf(stderr, "{\"event\": \"warning\", \"sentence\": %s}\n", json_text(sentence).c_str());
    else
        std::fprintf(stderr, "%scoseg: warning: %s\n", bar_shown_ ? "\r\033[K" : "", sentence.c_str());
}

double StageLog::seconds_since_start() const {
    return std::chrono::duration<double>(Clock::now() - start_).count();
}

}  // namespace coseg
