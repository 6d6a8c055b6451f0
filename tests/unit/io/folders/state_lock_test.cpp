#include "io/folders/state_lock.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <filesystem>
#include <thread>

#include "tests/support/errors.hpp"
#include "tests/support/temporary_folder.hpp"

namespace coseg {
namespace {

using test::content_of;
using test::error_of;
using test::TemporaryFolder;

constexpr LockTiming fast{std::chrono::milliseconds(20), std::chrono::milliseconds(200)};

TEST(StateLock, ASecondHolderIsRefusedAndToldWhoHasIt) {
    const TemporaryFolder folder;
    const std::string file = folder.path("lock");
    const StateLock first(file, LockMode::exclusive, fast);
    const auto caught = error_of([&] { const StateLock second(file, LockMode::exclusive, fast); });
    EXPECT_EQ(caught.code, ExitCode::output);
    EXPECT_NE(caught.sentence.find("in use by another run (host "), std::string::npos) << caught.sentence;
    EXPECT_NE(caught.sentence.find("process " + std::to_string(::getpid())), std::string::npos);
    EXPECT_TRUE(error_of([&] { const StateLock reader(file, LockMode::shared, fast); }).threw);
}

TEST(StateLock, IsFreeAfterItsHolder) {
    const TemporaryFolder folder;
    const std::string file = folder.path("lock");
    { const StateLock first(file, LockMode::exclusive, fast); }
    EXPECT_EQ(content_of(file), "");
    const StateLock second(file, LockMode::exclusive, fast);
    EXPECT_NE(content_of(file), "");
}

TEST(StateLock, SharedHoldersGoTogetherButNotWithAnExclusiveOne) {
    const TemporaryFolder folder;
    const std::string file = folder.path("lock");
    const StateLock first(file, LockMode::shared, fast);
    const StateLock second(file, LockMode::shared, fast);
    const auto caught = error_of([&] { const StateLock alone(file, LockMode::exclusive, fast); });
    EXPECT_NE(caught.sentence.find("in use by another coseg"), std::string::npos) << caught.sentence;
}

TEST(StateLock, AKilledProcessLeavesNoLock) {
    const TemporaryFolder folder;
    const std::string file = folder.path("lock");
    int ready[2];
    ASSERT_EQ(::pipe(ready), 0);
    const pid_t child = ::fork();
    if (child == 0) {
        const StateLock held(file, LockMode::exclusive, fast);
        const char word = 'x';
        if (::write(ready[1], &word, 1) != 1) ::_exit(1);
        ::pause();
        ::_exit(1);
    }
    char word = 0;
    ASSERT_EQ(::read(ready[0], &word, 1), 1);
    EXPECT_TRUE(error_of([&] { const StateLock refused(file, LockMode::exclusive, fast); }).threw);
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    EXPECT_NE(content_of(file), "") << "the record of the dead is still there";
    EXPECT_FALSE(error_of([&] { const StateLock taken(file, LockMode::exclusive, fast); }).threw);
    ::close(ready[0]);
    ::close(ready[1]);
}

TEST(StateLock, ASilentHolderOnAnotherHostIsTakenOver) {
    const TemporaryFolder folder;
    const std::string file =
        folder.file("lock", "host elsewhere.example, process 1, since 2001-01-01T00:00:00Z\n");
    EXPECT_FALSE(error_of([&] { const StateLock taken(file, LockMode::exclusive, fast); }).threw);
}

TEST(StateLock, ALivingHolderOnAnotherHostIsNot) {
    const TemporaryFolder folder;
    const std::string file =
        folder.file("lock", "host elsewhere.example, process 1, since 2001-01-01T00:00:00Z\n");
    std::atomic<bool> ended = false;
    std::thread heart([&] {  // what the other host's kernel would let through
        while (!ended) {
            std::filesystem::last_write_time(file, std::filesystem::file_time_type::clock::now());
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
    });
    LockTiming patient = fast;
    patient.patience = std::chrono::seconds(60);
    const auto caught = error_of([&] { const StateLock refused(file, LockMode::exclusive, patient); });
    ended = true;
    heart.join();
    EXPECT_NE(caught.sentence.find("elsewhere.example"), std::string::npos) << caught.sentence;
}

TEST(StateLock, SaysThatTheFolderCannotBeWritten) {
    const TemporaryFolder folder;
    const auto caught = error_of([&] { const StateLock lock(folder.path("absent/lock"), LockMode::shared); });
    EXPECT_EQ(caught.code, ExitCode::output);
    EXPECT_NE(caught.sentence.find("cannot be written"), std::string::npos);
}

}  // namespace
}  // namespace coseg
