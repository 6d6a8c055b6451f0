#include "io/data_files/name_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <thread>

#include "tests/support/errors.hpp"
#include "tests/support/temporary_folder.hpp"

namespace coseg {
namespace {

using test::error_of;
using test::TemporaryFolder;

TEST(NameFile, NumbersChooseTheLabel) {
    const TemporaryFolder folder;
    EXPECT_EQ(read_names(folder.file("a.txt", "2 leg\r\n\r\n0  seat \n7 left arm rest")),
              (LabelNames{{0, "seat"}, {2, "leg"}, {7, "left arm rest"}}));
}

TEST(NameFile, WithoutNumbersLinesCount) {
    const TemporaryFolder folder;
    EXPECT_EQ(read_names(folder.file("a.txt", "seat\n\nback rest\n")),
              (LabelNames{{0, "seat"}, {1, "back rest"}}));
    // One line without a number, or a number that is all of the name: the lines are names as they stand.
    EXPECT_EQ(read_names(folder.file("b.txt", "0 seat\nleg\n")), (LabelNames{{0, "0 seat"}, {1, "leg"}}));
    EXPECT_EQ(read_names(folder.file("c.txt", "5\n6\n")), (LabelNames{{0, "5"}, {1, "6"}}));
    EXPECT_EQ(read_names(folder.file("d.txt", "-1 none\n")), (LabelNames{{0, "-1 none"}}));
}

TEST(NameFile, BadFilesAreNamed) {
    const TemporaryFolder folder;
    const test::Caught twice = error_of([&] { read_names(folder.file("a.txt", "0 seat\n1 leg\n0 back\n")); });
    EXPECT_EQ(twice.code, ExitCode::input);
    EXPECT_NE(twice.sentence.find("a.txt:3: label 0 has a name already"), std::string::npos)
        << twice.sentence;
    for (const std::string& path : {folder.file("b.txt", "\n \n"), folder.path("gone.txt")}) {
        const test::Caught caught = error_of([&] { read_names(path); });
        EXPECT_EQ(caught.code, ExitCode::input) << path;
        EXPECT_NE(caught.sentence.find(path), std::string::npos) << caught.sentence;
    }
}

TEST(NameFile, TextOfOtherEncodings) {
    const TemporaryFolder folder;
    std::string utf16 = "\xff\xfe";
    for (const char c : std::string("seat\r\nr\xfc"
                                    "cken\r\n"))
        utf16.append({c, '\0'});
    for (const std::string& text : {utf16, std::string("\xEF\xBB\xBFseat\nr\xC3\xBC"
                                                       "cken\n")})
        EXPECT_EQ(read_names(folder.file("a.txt", text)), (LabelNames{{0, "seat"},
                                                                      {1,
                                                                       "r\xC3\xBC"
                                                                       "cken"}}));
}

TEST(NameFile, NamesAreFoundInAFolderOfResultsAndBesideTrueLabels) {
    const TemporaryFolder folder;
    EXPECT_EQ(names_in_folder(folder.path()), LabelNames());
    EXPECT_EQ(names_beside_truth(folder.path()), LabelNames());
    EXPECT_EQ(names_beside_truth(""), LabelNames());
    folder.file("names.txt", "seat\n");
    folder.file("labels.txt", "1 wing\n");
    EXPECT_EQ(names_in_folder(folder.path()), (LabelNames{{0, "seat"}}));
    EXPECT_EQ(names_beside_truth(folder.path()), (LabelNames{{1, "wing"}}));
}

TEST(NameFile, APipeIsReadWhereItIsNamedAndRefusedWhereItIsFound) {
    const TemporaryFolder folder;
    const std::string path = folder.path("names.txt");
    ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
    const test::Caught caught = error_of([&] { read_found_names(path); });
    EXPECT_EQ(caught.code, ExitCode::input);
    EXPECT_EQ(caught.sentence, path + ": is a pipe, not a file");
    std::thread writer([&] { std::ofstream(path) << "seat\n"; });
    EXPECT_EQ(read_names(path), (LabelNames{{0, "seat"}}));
    writer.join();
}

}  // namespace
}  // namespace coseg
