#include "io/data_files/label_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <limits>
#include <utility>

#include "io/files/atomic_file.hpp"
#include "tests/support/errors.hpp"
#include "tests/support/temporary_folder.hpp"

namespace coseg {
namespace {

using test::error_of;
using test::TemporaryFolder;

int files_in(const std::string& folder) {
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) count += entry.exists() ? 1 : 0;
    return count;
}

TEST(LabelFile, RoundTrip) {
    const TemporaryFolder folder;
    const std::vector<int> labels{
        0, 3, -1, 49, std::numeric_limits<int>::max(), std::numeric_limits<int>::min()};
    write_labels(folder.path("a.seg"), labels);
    EXPECT_EQ(test::content_of(folder.path("a.seg")), "0\n3\n-1\n49\n2147483647\n-2147483648\n");
    EXPECT_EQ(read_labels(folder.path("a.seg")), labels);
    EXPECT_EQ(read_labels(folder.path("a.seg"), 6), labels);
    EXPECT_EQ(files_in(folder.path()), 1);
}

TEST(LabelFile, OtherLineEndsAndBlankLines) {
    const TemporaryFolder folder;
    EXPECT_EQ(read_labels(folder.file("a.seg", "1\r\n 2 \r\n\r\n3"), 3), (std::vector<int>{1, 2, 3}));
    EXPECT_EQ(read_labels(folder.file("b.seg", ""), 0), std::vector<int>{});
}

TEST(LabelFile, TextOfOtherEncodings) {
    const TemporaryFolder folder;
    std::string utf16 = "\xff\xfe";
    for (const char c : std::string("1\r\n-1\r\n20\r\n")) utf16.append({c, '\0'});
    for (const std::string& text : {utf16, utf16.substr(2),
                                    std::string("\xEF\xBB\xBF"
                                                "1\n-1\n20\n")})
        EXPECT_EQ(read_labels(folder.file("a.seg", text), 3), (std::vector<int>{1, -1, 20}));
}

TEST(LabelFile, NamesOfAFolderWithoutHiddenFiles) {
    const TemporaryFolder folder;
    for (const char* name : {"b.seg", "a.b.seg", "._b.seg", ".seg", "c.txt"}) folder.file(name, "0\n");
    EXPECT_EQ(label_file_names(folder.path()), (std::vector<std::string>{"a.b", "b"}));
    const test::Caught caught = error_of([&] { label_file_names(folder.path("none")); });
    EXPECT_EQ(caught.code, ExitCode::input);
    EXPECT_TRUE(caught.sentence.starts_with(folder.path("none") + ": ")) << caught.sentence;
}

TEST(LabelFile, PipesAndDevicesInAFolderAreRefused) {
    const TemporaryFolder folder;
    ASSERT_EQ(::mkfifo(folder.path("a.seg").c_str(), 0600), 0);
    std::filesystem::create_symlink("/dev/zero", folder.path("b.seg"));
    for (const auto& [name, words] :
         {std::pair("a.seg", "is a pipe, not a file"), std::pair("b.seg", "is a device")}) {
        const std::string path = folder.path(name);
        const test::Caught caught = error_of([&] { read_labels(path, 3); });
        EXPECT_EQ(caught.code, ExitCode::input);
        EXPECT_TRUE(caught.sentence.starts_with(path + ": " + words)) << caught.sentence;
    }
}

TEST(LabelFile, WrongCountNamesFileLineAndBothCounts) {
    const TemporaryFolder folder;
    const test::Caught caught = error_of([&] { read_labels(folder.file("a.seg", "1\n2\n3\n"), 5); });
    EXPECT_EQ(caught.code, ExitCode::input);
    for (const std::string word : {"a.seg:3:", "3 labels", "5 faces"})
        EXPECT_NE(caught.sentence.find(word), std::string::npos) << caught.sentence;
}

TEST(LabelFile, BadLinesAreNamed) {
    const TemporaryFolder folder;
    for (const std::string bad : {"x", "1.5", "1 2", "99999999999", "0x1", "-"}) {
        const test::Caught caught =
            error_of([&] { read_labels(folder.file("a.seg", "1\n" + bad + "\n3\n"), 3); });
        EXPECT_EQ(caught.code, ExitCode::input) << bad;
        EXPECT_NE(caught.sentence.find("a.seg:2:"), std::string::npos) << caught.sentence;
    }
    EXPECT_EQ(error_of([&] { read_labels(folder.path("none.seg"), 3); }).code, ExitCode::input);
}

TEST(AtomicFile, FailureLeavesTheOldFileAndNoTemporary) {
    const TemporaryFolder folder;
    folder.file("a.seg", "old\n");
    try {
        AtomicFile file(folder.path("a.seg"));
        file.stream() << "new";
        throw std::runtime_error("on the way");
    } catch (const std::runtime_error&) {
    }
    EXPECT_EQ(test::content_of(folder.path("a.seg")), "old\n");
    EXPECT_EQ(files_in(folder.path()), 1);
}

TEST(AtomicFile, ErrorsNamePathAndCause) {
    const TemporaryFolder folder;
    const test::Caught missing = error_of([&] { write_labels(folder.path("none/a.seg"), {1}); });
    EXPECT_EQ(missing.code, ExitCode::output);
    EXPECT_NE(missing.sentence.find(folder.path("none/a.seg")), std::string::npos);
    EXPECT_NE(missing.sentence.find("No such file or directory"), std::string::npos);
    std::filesystem::create_directories(folder.path("b.seg/inside"));
    const test::Caught taken = error_of([&] { write_labels(folder.path("b.seg"), {1}); });
    EXPECT_EQ(taken.code, ExitCode::output);
    EXPECT_EQ(files_in(folder.path()), 1);  // the folder b.seg, no temporary
}

}  // namespace
}  // namespace coseg
