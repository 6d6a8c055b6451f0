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

TEST(AtomicFile, WhatNoFileCanBeIsRefusedBeforeAnythingIsWritten) {
    const TemporaryFolder folder;
    fs::create_directory(folder.path("taken"));
    const std::string longest = folder.path(std::string(255, 'n'));
    for (const std::string& path : {folder.path("taken"), longest + "n", folder.path("nowhere/file")}) {
        EXPECT_THROW(AtomicFile{path}, Error) << path;
        EXPECT_THROW(try_file(path), Error) << path;
    }
    try_file("");
    try_file("/dev/full");
    try_file(longest);
    EXPECT_FALSE(fs::exists(longest));
    fs::remove(folder.path("taken"));
    EXPECT_TRUE(fs::is_empty(folder.path("")));
    write_file(longest, "all of it");
    EXPECT_EQ(read_file(longest), "all of it");
}

}  // namespace
}  // namespace coseg
