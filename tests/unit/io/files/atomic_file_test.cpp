#include "io/files/atomic_file.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <filesystem>

#include "io/files/file_contents.hpp"
#include "src/base/error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace coseg {
namespace {

namespace fs = std::filesystem;
using test::TemporaryFolder;

TEST(AtomicFile, ALinkStaysAndWhatItLeadsToIsReplaced) {
    const TemporaryFolder folder;
    folder.file("target", "before");
    fs::create_symlink("target", folder.path("link"));
    write_file(folder.path("link"), "after");
    EXPECT_TRUE(fs::is_symlink(folder.path("link")));
    EXPECT_EQ(read_file(folder.path("target")), "after");
    fs::create_symlink("nowhere", folder.path("dangling"));
    write_file(folder.path("dangling"), "new");
    EXPECT_EQ(read_file(folder.path("dangling")), "new");
}

TEST(AtomicFile, APipeIsWrittenToAndStays) {
    const TemporaryFolder folder;
    const std::string pipe = folder.path("pipe");
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    const int reader = ::open(pipe.c_str(), O_RDWR);  // so that neither end waits for the other
    ASSERT_GE(reader, 0);
    write_file(pipe, "through");
    { const AtomicFile abandoned(pipe); }
    std::array<char, 16> bytes{};
    EXPECT_EQ(::read(reader, bytes.data(), bytes.size()), 7);
    EXPECT_STREQ(bytes.data(), "through");
    ::close(reader);
    EXPECT_TRUE(fs::is_fifo(pipe));
}

TEST(AtomicFile, AFullDeviceIsAFailureAndStays) {
    EXPECT_THROW(write_file("/dev/full", "something"), Error);
    EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

}  // namespace
}  // namespace coseg
