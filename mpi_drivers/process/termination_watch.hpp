#pragma once
// What is undone when the process is told to end.

#include <csignal>
#include <functional>
#include <thread>

namespace coseg {

/// While it lives, SIGINT, SIGTERM and SIGHUP first run `undo`, on a thread of its own, and then end the process as
/// they would without it. A signal that is ignored (nohup) stays ignored. `undo` may run at any moment beside
/// the owner's work and must not throw. At most one in a process.
class TerminationWatch {
  public:
    /// Throws Error(internal) if the system has no pipe or thread left.
    explicit TerminationWatch(std::function<void()> undo);
    ~TerminationWatch();
    TerminationWatch(const TerminationWatch&) = delete;
    TerminationWatch& operator=(const TerminationWatch&) = delete;

  private:
    std::thread thread_;
};

/// While it lives, this thread puts those signals off: what must be undone can so be made together with its watch.
class TerminationPause {
  public:
    TerminationPause();
    ~TerminationPause();
    TerminationPause(const TerminationPause&) = delete;
    TerminationPause& operator=(const TerminationPause&) = delete;

  private:
    sigset_t before_{};
};

}  // namespace coseg
