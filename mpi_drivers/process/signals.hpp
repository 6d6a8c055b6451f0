#pragma once
// The signals that the program answers; nothing else in it sets a handler.
//
// | signal         | while stop requests are heeded | while only a TerminationWatch lives |
// | ---            | ---                            | ---                                 |
// | SIGUSR1        | raises a flag                  | -                                   |
// | SIGTERM        | raises a flag                  | undoes, then ends the process       |
// | SIGINT, SIGHUP | as in the next column          | undoes, then ends the process       |
//
// Everything else does what it did when the process was started. The table holds in whichever order the
// objects below are made. A signal that is ignored when a watch begins (as under nohup) stays ignored. PETSc
// is kept from setting handlers (petsc_session.hpp); Open MPI's are for crashes.

#include <csignal>
#include <functional>
#include <thread>

namespace coseg {

/// Makes the program heed stop requests from now on, also after a StopRequest has gone. A signal that arrives
/// while the program starts or ends then counts like one that comes in between.
void heed_stop_requests();

/// A write beyond what `ulimit -f` allows fails from now on, as on a full disk, instead of ending the process
/// (SIGXFSZ).
void let_long_files_fail();

/// During its lifetime stop requests are heeded: the stages look at the flag between meshes and iterations,
/// and end with the state written. There is at most one in a process.
class StopRequest {
  public:
    StopRequest();
    ~StopRequest();
    StopRequest(const StopRequest&) = delete;
    StopRequest& operator=(const StopRequest&) = delete;

    /// Whether a signal has come. Not collective.
    [[nodiscard]] bool is_raised() const noexcept;
};

/// During its lifetime the signals of the table first run `undo`, on a thread of its own, and then end the
/// process as they would without it. `undo` may run at any moment beside the owner's work and must not throw.
/// There is at most one in a process.
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

/// During its lifetime this thread postpones the signals of a TerminationWatch. By this, something that must
/// be undone can be made together with its watch.
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
