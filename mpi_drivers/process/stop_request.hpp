#pragma once
// Whether the process has been asked to write its state and end.

#include <array>
#include <csignal>

namespace coseg {

/// From now on SIGUSR1 and SIGTERM raise the flag of the StopRequest to come: a signal that arrives while the program starts
/// then ends it as one that comes later does.
void heed_stop_requests();

/// While it lives, SIGUSR1 and SIGTERM only raise a flag, which the stages look at between meshes and iterations.
/// At most one in a process.
class StopRequest {
  public:
    StopRequest();
    ~StopRequest();
    StopRequest(const StopRequest&) = delete;
    StopRequest& operator=(const StopRequest&) = delete;

    /// Takes the signals back from whoever has set handlers since (a TerminationWatch made later).
    void rearm() noexcept;

    /// Has a signal come? Not collective.
    [[nodiscard]] bool is_raised() const noexcept;

  private:
    std::array<struct sigaction, 2> before_{};
};

}  // namespace coseg
