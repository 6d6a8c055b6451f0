#include "mpi_drivers/process/stop_request.hpp"

namespace coseg {

namespace {

constexpr std::array<int, 2> heeded{SIGUSR1, SIGTERM};
volatile std::sig_atomic_t raised = 0;
bool heeded_from_start = false;

void raise_flag(int /*signal*/) { raised = 1; }

void set_handlers() {
    struct sigaction action {};
    action.sa_handler = raise_flag;
    action.sa_flags = SA_RESTART;
    for (const int signal : heeded) sigaction(signal, &action, nullptr);
}

}  // namespace

void heed_stop_requests() {
    heeded_from_start = true;
    set_handlers();
}

StopRequest::StopRequest() {
    if (!heeded_from_start) raised = 0;
    for (std::size_t k = 0; k < heeded.size(); ++k) sigaction(heeded[k], nullptr, &before_[k]);
    rearm();
}

StopRequest::~StopRequest() {
    for (std::size_t k = 0; k < heeded.size(); ++k) sigaction(heeded[k], &before_[k], nullptr);
}

void StopRequest::rearm() noexcept { set_handlers(); }

bool StopRequest::is_raised() const noexcept { return raised != 0; }

}  // namespace coseg
