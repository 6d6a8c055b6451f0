#include "mpi_drivers/stop_request.hpp"

namespace coseg {

namespace {

constexpr std::array<int, 2> heeded{SIGUSR1, SIGTERM};
volatile std::sig_atomic_t raised = 0;

void raise_flag(int /*signal*/) { raised = 1; }

}  // namespace

StopRequest::StopRequest() {
    raised = 0;
    for (std::size_t k = 0; k < heeded.size(); ++k) sigaction(heeded[k], nullptr, &before_[k]);
    rearm();
}

StopRequest::~StopRequest() {
    for (std::size_t k = 0; k < heeded.size(); ++k) sigaction(heeded[k], &before_[k], nullptr);
}

void StopRequest::rearm() noexcept {
    struct sigaction action {};
    action.sa_handler = raise_flag;
    action.sa_flags = SA_RESTART;
    for (const int signal : heeded) sigaction(signal, &action, nullptr);
}

bool StopRequest::is_raised() const noexcept { return raised != 0; }

}  // namespace coseg
