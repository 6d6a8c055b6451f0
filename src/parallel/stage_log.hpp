#pragma once
// Measures the time of each stage: one line of progress on rank 0, and one row of the report's table.

#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "src/parallel/comm.hpp"
#include "src/parallel/trace_event.hpp"
#include "src/records/stage_times.hpp"

namespace coseg {

enum class Verbosity { quiet, normal, verbose };
enum class LogForm { text, json };

/// What a program hears of a run that it has started through the library, in place of lines on standard
/// error. Every rank is told.
struct StageListener {
    /// The stage, and how much is done of how much: 0 of 0 at its beginning, 1 of 1 at its end. What it
    /// throws leaves the stage at once, which is only safe where there is no other rank that waits for this
    /// one.
    std::function<void(const std::string& stage, std::int64_t done, std::int64_t total)> progress;
    std::function<void(const std::string& sentence)> warning;
};

/// Lines go to standard error, so that standard output holds results only.
class StageLog {
  public:
    using Clock = std::chrono::steady_clock;

    /// With verbose, the steps of each stage are printed under its line. With json, there is one JSON object
    /// a line for every stage and warning, and no bar.
    StageLog(const Comm& comm, Verbosity verbosity, LogForm form = LogForm::text);

    /// Nothing is printed.
    StageLog(const Comm& comm, StageListener listener);

    void begin(const std::string& stage);

    /// Prints the share done and the time left on rank 0. Where standard error is a terminal, one line is
    /// drawn over again and again; otherwise there is one line a minute. Not collective.
    void progress(std::int64_t done, std::int64_t total);

    /// Ends this rank's own work in the stage. The time from here until end() is waiting. Not collective.
    void end_of_own_work();

    /// Adds to the time that this rank has spent on a step of the stage. Not collective, but every rank must
    /// name the same steps in the same order before end().
    void step(const std::string& name, double seconds);

    /// From here on the spans of this rank are kept for trace(). Their starts are counted from the moment at
    /// which all ranks have come here. Collective.
    void keep_trace();

    /// Notes a span inside the current stage, if spans are kept. Not collective.
    void span(const std::string& name, const std::string& category, Clock::time_point start,
              Clock::time_point end);

    /// Closes the stage and prints its line, with `summary` as what rank 0 says of the result. Collective.
    void end(const std::string& summary);

    /// Prints a sentence about the whole run on rank 0, and keeps it on every rank for the report. Not
    /// collective.
    void warn(const std::string& sentence);

    /// Prints a sentence on rank 0 that the report has elsewhere, as with its shape. Not collective.
    void print_warning(const std::string& sentence) const;

    /// Keeps a sentence for the report that is told in another way. Not collective.
    void keep_warning(const std::string& sentence) { warnings_.push_back(sentence); }

    /// What warn() was given and keep_warning(), in this order.
    [[nodiscard]] const std::vector<std::string>& warnings() const noexcept { return warnings_; }

    [[nodiscard]] const std::vector<StageTimes>& stages() const noexcept { return stages_; }
    [[nodiscard]] double seconds_since_start() const;

    /// The spans of this rank: the stages, what span() noted in them, and as "wait" the time after the rank's
    /// own work.
    [[nodiscard]] const RankTrace& trace() const noexcept { return trace_; }

  private:
    void clear_bar();
    void print_progress(std::int64_t done, std::int64_t total);
    [[nodiscard]] bool shows_bar() const;
    void print(const StageTimes& times, const std::string& summary) const;

    const Comm& comm_;
    Verbosity verbosity_;
    LogForm form_;
    StageListener listener_;
    bool is_terminal_;
    bool bar_shown_ = false;
    std::string stage_;
    Clock::time_point start_ = Clock::now();
    Clock::time_point stage_start_;
    Clock::time_point last_progress_;
    double own_seconds_ = -1.0;
    std::vector<StepTime> steps_;  // of this rank
    std::vector<StageTimes> stages_;
    std::vector<std::string> warnings_;
    bool keeps_trace_ = false;
    Clock::time_point trace_start_;
    RankTrace trace_;
};

}  // namespace coseg
