#pragma once
// Measures the time that has passed.

#include <chrono>

namespace coseg {

/// Runs from the moment at which it is made, by a clock that nobody can set. The program takes all durations
/// in this way.
class Stopwatch {
  public:
    using Clock = std::chrono::steady_clock;

    [[nodiscard]] double seconds() const {
        return std::chrono::duration<double>(Clock::now() - start_).count();
    }

  private:
    Clock::time_point start_ = Clock::now();
};

}  // namespace coseg
