#include "io/files/folder_entries.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.hpp"

namespace coseg {
namespace {

namespace fs = std::filesystem;
using test::TemporaryFolder;

std::vector<std::string> names_in(const std::string& folder) {
    std::error_code cause;
    std::vector<std::string> names;
    for (const fs::path& path : folder_entries(folder, cause)) names.push_back(path.filename().string());
    return names;
}

TEST(FolderEntries, AreSortedAndHoldEveryKind) {
    const TemporaryFolder folder;
    for (const char* name : {"b", "a.txt", ".hidden", "a", "B", "a.10", "a.9"}) folder.file(name, "");
    fs::create_directories(folder.path("c/below"));
    fs::create_symlink("nowhere", folder.path("a link"));
    EXPECT_EQ(names_in(folder.path()),
              (std::vector<std::string>{".hidden", "B", "a", "a link", "a.10", "a.9", "a.txt", "b", "c"}));
}

TEST(FolderEntries, SayWhyAFolderCannotBeRead) {
    const TemporaryFolder folder;
    std::error_code cause;
    EXPECT_TRUE(folder_entries(folder.path("absent"), cause).empty());
    EXPECT_EQ(cause, std::errc::no_such_file_or_directory);
    EXPECT_TRUE(folder_entries(folder.file("file", ""), cause).empty());
    EXPECT_EQ(cause, std::errc::not_a_directory);
    EXPECT_EQ(folder_entries(folder.path(), cause).size(), 1U);
    EXPECT_FALSE(cause);
}

TEST(FolderEntries, OnlyFilesOfAnEarlierResultAreRemoved) {
    const TemporaryFolder folder;
    const auto is_seg = [](const fs::path& path) { return path.extension() == ".seg"; };
    remove_earlier_files(folder.path("absent"), is_seg);
    for (const char* name : {"a.seg", "b.seg", "b.txt"}) folder.file(name, "");
    fs::create_directories(folder.path("c.seg"));
    remove_earlier_files(folder.path(), is_seg);
    EXPECT_EQ(names_in(folder.path()), (std::vector<std::string>{"b.txt", "c.seg"}));
}

}  // namespace
}  // namespace coseg
