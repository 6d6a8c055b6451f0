#pragma once
// The time that has passed.

#include <chrono>

namespace coseg {

/// Runs from when it is made, by a clock that nobody sets: the one way in which the program takes durations.
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
