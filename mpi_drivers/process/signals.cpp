#include "mpi_drivers/process/signals.hpp"

#include <unistd.h>

#include <array>
#include <cstdlib>
#include <optional>
#include <system_error>
#include <utility>

#include "src/base/error.hpp"

namespace coseg {

namespace {

struct AnsweredSignal {
    int number;
    bool asks_to_stop;
    bool ends_process;
    std::optional<struct sigaction> before;  // while a handler of ours is set
};

std::array<AnsweredSignal, 4> answered{{{SIGUSR1, true, false, {}},
                                        {SIGTERM, true, true, {}},
                                        {SIGINT, false, true, {}},
                                        {SIGHUP, false, true, {}}}};

volatile std::sig_atomic_t stop_raised = 0;
bool heeded_for_good = false;
bool stop_request_lives = false;
bool watch_lives = false;

constexpr unsigned char no_signal = 0;
std::array<int, 2> channel{-1, -1};  // read end, write end

void send(unsigned char word) {
    if (::write(channel[1], &word, 1) != 1) std::abort();
}

// Handlers: only what is safe in one.
void raise_flag(int /*signal*/) { stop_raised = 1; }
void pass_on(int signal) { send(static_cast<unsigned char>(signal)); }

void (*handler_for(const AnsweredSignal& signal))(int) {
    if (signal.asks_to_stop && (heeded_for_good || stop_request_lives)) return raise_flag;
    if (signal.ends_process && watch_lives) return pass_on;
    return nullptr;
}

void set_handler(AnsweredSignal& signal) {
    const auto handler = handler_for(signal);
    if (handler == nullptr) {
        if (signal.before) sigaction(signal.number, &*signal.before, nullptr);
        signal.before.reset();
        return;
    }
    if (!signal.before) {
        struct sigaction before {};
        sigaction(signal.number, nullptr, &before);
        if (handler == pass_on && before.sa_handler == SIG_IGN) return;
        signal.before = before;
    }
    struct sigaction action {};
    action.sa_handler = handler;
    action.sa_flags = SA_RESTART;
    sigaction(signal.number, &action, nullptr);
}

/// Makes the table of the header true again after one of the flags above has changed.
void set_handlers() {
    for (AnsweredSignal& signal : answered) set_handler(signal);
}

void end_process(int signal) {
    struct sigaction plain {};
    plain.sa_handler = SIG_DFL;
    sigaction(signal, &plain, nullptr);
    sigset_t signals;  // this thread may have been started in a TerminationPause
    sigemptyset(&signals);
    sigaddset(&signals, signal);
    pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
    std::raise(signal);
}

void wait_and_undo(const std::function<void()>& undo) {
    unsigned char word = no_signal;
    while (::read(channel[0], &word, 1) < 0) {
    }
    if (word == no_signal) return;
    undo();
    end_process(word);
}

void close_channel() {
    ::close(channel[0]);
    ::close(channel[1]);
}

}  // namespace

void heed_stop_requests() {
    heeded_for_good = true;
    set_handlers();
}

void let_long_files_fail() { std::signal(SIGXFSZ, SIG_IGN); }

StopRequest::StopRequest() {
    if (!heeded_for_good) stop_raised = 0;
    stop_request_lives = true;
    set_handlers();
}

StopRequest::~StopRequest() {
    stop_request_lives = false;
    set_handlers();
}

bool StopRequest::is_raised() const noexcept { return stop_raised != 0; }

TerminationWatch::TerminationWatch(std::function<void()> undo) {
    if (::pipe(channel.data()) != 0) throw Error(ExitCode::internal, "no pipe is left to watch for signals");
    try {
        thread_ = std::thread([undo = std::move(undo)] { wait_and_undo(undo); });
    } catch (const std::system_error&) {
        close_channel();
        throw Error(ExitCode::internal, "no thread is left to watch for signals");
    }
    watch_lives = true;
    set_handlers();
}

TerminationWatch::~TerminationWatch() {
    watch_lives = false;
    set_handlers();
    send(no_signal);
    thread_.join();
    close_channel();
}

TerminationPause::TerminationPause() {
    sigset_t signals;
    sigemptyset(&signals);
    for (const AnsweredSignal& signal : answered) {
        if (signal.ends_process) sigaddset(&signals, signal.number);
    }
    pthread_sigmask(SIG_BLOCK, &signals, &before_);
}

TerminationPause::~TerminationPause() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

}  // namespace coseg
