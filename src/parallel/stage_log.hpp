#pragma once
// One scoped timer a stage: one line of progress on rank 0, and a row of the report's table.

#include <chrono>
#include <string>
#include <vector>

#include "src/parallel/comm.hpp"
#include "src/parallel/trace_event.hpp"
#include "src/records/stage_times.hpp"

namespace coseg {

enum class Verbosity { quiet, normal, verbose };
enum class LogForm { text, json };

/// Lines go to standard error, so that standard output holds results only.
class StageLog {
  public:
    using Clock = std::chrono::steady_clock;

    /// verbose: the steps of each stage under its line. json: one JSON object a line for every stage and warning, no bar.
    StageLog(const Comm& comm, Verbosity verbosity, LogForm form = LogForm::text);

    void begin(const std::string& stage);

    /// The share done and the time left, on rank 0: in one line that is drawn over where standard error is a terminal, else a
    /// line a minute. Not collective.
    void progress(std::int64_t done, std::int64_t total);

    /// Ends this rank's own work in the stage: what follows until end() is waiting. Not collective.
    void end_of_own_work();

    /// Says how long this rank spent on a step of the stage. Not collective, but every rank must name the same
    /// steps in the same order before end().
    void step(const std::string& name, double seconds);

    /// From here on the spans of this rank are kept for trace(), their starts counted from the moment at which all
    /// ranks have come here. Collective.
    void keep_trace();

    /// Notes a span inside the current stage, if spans are kept. Not collective.
    void span(const std::string& name, const std::string& category, Clock::time_point start,
              Clock::time_point end);

    /// Collective: closes the stage and prints its line, `summary` being what rank 0 says of the result.
    void end(const std::string& summary);

    /// Prints a sentence on rank 0 once, whatever rank says it first. Not collective; root only speaks.
    void warn(const std::string& sentence) const;

    [[nodiscard]] const std::vector<StageTimes>& stages() const noexcept { return stages_; }
    [[nodiscard]] double seconds_since_start() const;

    /// Spans of this rank: stages, what span() noted in them, and as "wait" what followed the rank's own work.
    [[nodiscard]] const RankTrace& trace() const noexcept { return trace_; }

  private:
    void clear_bar();
    void print_progress(std::int64_t done, std::int64_t total);
    [[nodiscard]] bool shows_bar() const;
    void print(const StageTimes& times, const std::string& summary) const;

    const Comm& comm_;
    Verbosity verbosity_;
    LogForm form_;
    bool is_terminal_;
    bool bar_shown_ = false;
    std::string stage_;
    Clock::time_point start_ = Clock::now();
    Clock::time_point stage_start_;
    Clock::time_point last_progress_;
    double own_seconds_ = -1.0;
    std::vector<StepTime> steps_;  // of this rank
    std::vector<StageTimes> stages_;
    bool keeps_trace_ = false;
    Clock::time_point trace_start_;
    RankTrace trace_;
};

}  // namespace coseg
