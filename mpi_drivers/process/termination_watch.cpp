#include "mpi_drivers/process/termination_watch.hpp"

#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <system_error>
#include <utility>

#include "src/base/error.hpp"

namespace coseg {

namespace {

constexpr std::array<int, 3> watched{SIGINT, SIGTERM, SIGHUP};
constexpr unsigned char stop = 0;  // not a signal

std::array<int, 2> channel{-1, -1};  // read end, write end
std::array<struct sigaction, watched.size()> before;

void send(unsigned char word) {
    if (::write(channel[1], &word, 1) != 1) std::abort();
}

/// Only calls that are safe in a signal handler.
void pass_on(int signal) { send(static_cast<unsigned char>(signal)); }

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
    unsigned char word = stop;
    while (::read(channel[0], &word, 1) < 0) {
    }
    if (word == stop) return;
    undo();
    end_process(word);
}

void set_handlers() {
    struct sigaction action {};
    action.sa_handler = pass_on;
    action.sa_flags = SA_RESTART;
    for (std::size_t k = 0; k < watched.size(); ++k) {
        sigaction(watched[k], nullptr, &before[k]);
        if (before[k].sa_handler != SIG_IGN) sigaction(watched[k], &action, nullptr);
    }
}

void close_channel() {
    ::close(channel[0]);
    ::close(channel[1]);
}

}  // namespace

TerminationWatch::TerminationWatch(std::function<void()> undo) {
    if (::pipe(channel.data()) != 0) throw Error(ExitCode::internal, "no pipe is left to watch for signals");
    try {
        thread_ = std::thread([undo = std::move(undo)] { wait_and_undo(undo); });
    } catch (const std::system_error&) {
        close_channel();
        throw Error(ExitCode::internal, "no thread is left to watch for signals");
    }
    set_handlers();
}

TerminationWatch::~TerminationWatch() {
    for (std::size_t k = 0; k < watched.size(); ++k) sigaction(watched[k], &before[k], nullptr);
    send(stop);
    thread_.join();
    close_channel();
}

TerminationPause::TerminationPause() {
    sigset_t signals;
    sigemptyset(&signals);
    for (const int signal : watched) sigaddset(&signals, signal);
    pthread_sigmask(SIG_BLOCK, &signals, &before_);
}

TerminationPause::~TerminationPause() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

}  // namespace coseg
