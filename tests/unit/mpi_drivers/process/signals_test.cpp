#include "mpi_drivers/process/signals.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <memory>

namespace coseg {
namespace {

/// What a signal does now.
void (*handler_of(int signal))(int) {
    struct sigaction action {};
    sigaction(signal, nullptr, &action);
    return action.sa_handler;
}

[[noreturn]] void wait_for_the_end() {
    while (true) pause();
}

TEST(Signals, AStopRequestOnlyRaisesAFlagAndGivesTheSignalsBack) {
    const auto usr1 = handler_of(SIGUSR1);
    const auto term = handler_of(SIGTERM);
    for (const int signal : {SIGUSR1, SIGTERM}) {
        const StopRequest request;
        EXPECT_FALSE(request.is_raised());
        std::raise(signal);
        EXPECT_TRUE(request.is_raised());
    }
    EXPECT_EQ(handler_of(SIGUSR1), usr1);
    EXPECT_EQ(handler_of(SIGTERM), term);
}

TEST(Signals, AStopRequestComesBeforeAWatchInWhicheverOrderTheyAreMade) {
    bool undone = false;
    for (const bool request_first : {false, true}) {
        std::unique_ptr<StopRequest> request;
        if (request_first) request = std::make_unique<StopRequest>();
        const TerminationWatch watch([&] { undone = true; });
        if (!request_first) request = std::make_unique<StopRequest>();
        std::raise(SIGTERM);
        EXPECT_TRUE(request->is_raised());
    }
    EXPECT_FALSE(undone);
    EXPECT_EQ(handler_of(SIGINT), SIG_DFL);
}

TEST(Signals, AnIgnoredSignalStaysIgnored) {
    const auto before = std::signal(SIGHUP, SIG_IGN);
    {
        const TerminationWatch watch([] {});
        EXPECT_EQ(handler_of(SIGHUP), SIG_IGN);
    }
    EXPECT_EQ(handler_of(SIGHUP), SIG_IGN);
    std::signal(SIGHUP, before);
}

TEST(SignalsDeathTest, AWatchUndoesAndLetsTheSignalEndTheProcess) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        EXPECT_EXIT(
            {
                const TerminationWatch watch([] { std::fputs("undone", stderr); });
                std::raise(signal);
                wait_for_the_end();
            },
            testing::KilledBySignal(signal), "undone");
    }
}

TEST(SignalsDeathTest, ASignalInAPauseIsAnsweredAfterIt) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_EXIT(
        {
            auto pause = std::make_unique<TerminationPause>();
            std::raise(SIGTERM);
            const TerminationWatch watch([] { std::fputs("undone", stderr); });
            std::fputs("made and ", stderr);
            pause.reset();
            wait_for_the_end();
        },
        testing::KilledBySignal(SIGTERM), "made and undone");
}

TEST(SignalsDeathTest, WhatIsHeededFromTheStartIsHeededToTheEnd) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_EXIT(
        {
            heed_stop_requests();
            std::raise(SIGUSR1);
            {
                const StopRequest request;
                if (!request.is_raised()) std::exit(1);
            }
            std::raise(SIGTERM);
            std::exit(7);
        },
        testing::ExitedWithCode(7), "");
}

}  // namespace
}  // namespace coseg
