#include "io/files/file_contents.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <thread>

#include "tests/support/errors.hpp"
#include "tests/support/temporary_folder.hpp"

namespace coseg {
namespace {

using test::TemporaryFolder;

TEST(FileContents, EveryByteOfAFile) {
    const TemporaryFolder folder;
    EXPECT_EQ(read_file(folder.file("empty", "")), "");
    std::string bytes("a\0b\r\n", 5);
    EXPECT_EQ(read_file(folder.file("small", bytes)), bytes);
    for (int k = 0; k < 16; ++k) bytes += bytes;
    EXPECT_EQ(read_file(folder.file("large", bytes)), bytes);
}

TEST(FileContents, APipeIsReadToItsEnd) {
    const TemporaryFolder folder;
    const std::string path = folder.path("pipe");
    ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
    const std::string bytes(300000, 'x');
    std::thread writer([&] { std::ofstream(path, std::ios::binary) << bytes; });
    EXPECT_EQ(read_file(path), bytes);
    writer.join();
}

TEST(FileContents, NoMoreMemoryThanTheFileHas) {
    const TemporaryFolder folder;
    EXPECT_LE(read_file(folder.file("large", std::string(3000000, 'x'))).capacity(), 3000000U);
}

TEST(FileContents, FoldersAndMissingFilesAreErrors) {
    const TemporaryFolder folder;
    EXPECT_EQ(test::error_of([&] { read_file(folder.path()); }).code, ExitCode::input);
    EXPECT_NE(test::error_of([&] { read_file(folder.path("none")); }).sentence.find(folder.path("none")),
              std::string::npos);
}

}  // namespace
}  // namespace coseg
