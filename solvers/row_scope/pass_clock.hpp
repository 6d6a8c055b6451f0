#pragma once
// Measures the time of the passes over all pairs.

#include <ctime>

#include "solvers/subspace/solve_result.hpp"
#include "src/base/stopwatch.hpp"

namespace coseg {

/// Adds the time between its construction and its destruction to a cost.
class PassClock {
  public:
    explicit PassClock(PassCost& cost) : cost_(cost), cpu_(cpu_seconds()) {}
    ~PassClock() {
        cost_.wall_seconds += wall_.seconds();
        cost_.cpu_seconds += cpu_seconds() - cpu_;
    }
    PassClock(const PassClock&) = delete;
    PassClock& operator=(const PassClock&) = delete;

    /// The CPU time of this process, of all its threads.
    static double cpu_seconds() {
        std::timespec time{};
        clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
        return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
    }

  private:
    PassCost& cost_;
    Stopwatch wall_;
    double cpu_;
};

/// Adds the time between its construction and its destruction, which encloses collective calls, to a cost.
class CommunicationClock {
  public:
    explicit CommunicationClock(PassCost& cost) : cost_(cost), cpu_(PassClock::cpu_seconds()) {}
    ~CommunicationClock() {
        cost_.communication_seconds += wall_.seconds();
        cost_.waiting_cpu_seconds += PassClock::cpu_seconds() - cpu_;
    }
    CommunicationClock(const CommunicationClock&) = delete;
    CommunicationClock& operator=(const CommunicationClock&) = delete;

  private:
    PassCost& cost_;
    Stopwatch wall_;
    double cpu_;
};

}  // namespace coseg
