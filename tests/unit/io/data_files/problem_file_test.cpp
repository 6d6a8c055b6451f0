#include "io/data_files/problem_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "src/base/error.hpp"

namespace coseg {
namespace {

class ProblemFileTest : public testing::Test {
  protected:
    void SetUp() override {
        path_ =
            std::filesystem::temp_directory_path() / ("coseg_problem_" + std::to_string(getpid()) + ".txt");
    }
    void TearDown() override { std::filesystem::remove(path_); }

    ProblemFile read(const std::string& text) {
        std::ofstream(path_) << text;
        return read_problem_file(path_.string());
    }

    /// The sentence with which `text` is refused.
    std::string refusal(const std::string& text) {
        try {
            read(text);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::input);
            return error.what();
        }
        return "accepted";
    }

    std::filesystem::path path_;
};

const std::string head = "2 2 3\n10 0.5 0.25\n7 6\n";

TEST_F(ProblemFileTest, ReadsFeaturesRowByRow) {
    const ProblemFile problem = read(head + "1 2 3\n4 5 6\n\n7 8 9\r\n1e1 0 0.5\n");
    EXPECT_EQ(problem.lambda, 10.0);
    EXPECT_EQ(problem.alpha, 0.5);
    EXPECT_EQ(problem.beta, 0.25);
    EXPECT_EQ(problem.known_upper, 7.0);
    ASSERT_EQ(problem.features.size(), 2U);
    EXPECT_EQ(problem.features[0](1, 0), 4.0);
    EXPECT_EQ(problem.features[1](0, 2), 9.0);
    EXPECT_EQ(problem.features[1](1, 0), 10.0);
}

TEST_F(ProblemFileTest, RefusalsNameFileAndLine) {
    EXPECT_NE(refusal(head + "1 2 3\n4 x 6\n7 8 9\n1 1 1\n").find(path_.string() + ", line 5: 'x'"),
              std::string::npos);
    EXPECT_NE(refusal(head + "1 2 3\n4 5 6\n7 nan 9\n1 1 1\n").find("line 6: 'nan' is not a finite"),
              std::string::npos);
    EXPECT_NE(refusal(head + "1 2 3\n4 5 6\n7 8 -9\n1 1 1\n").find("line 6: column 3 of feature 2"),
              std::string::npos);
    EXPECT_NE(refusal(head + "1 2 3\n4 5\n7 8 9\n1 1 1\n").find("line 5: the line ends"), std::string::npos);
    EXPECT_NE(refusal(head + "1 2 3\n4 5 6 7\n7 8 9\n1 1 1\n").find("line 5: the line goes on with '7'"),
              std::string::npos);
    EXPECT_NE(refusal(head + "1 2 3\n4 5 6\n7 8 9\n").find("row 2 of feature 2"), std::string::npos);
    EXPECT_NE(refusal(head + "1 2 3\n4 5 6\n7 8 9\n1 1 1\n1 1 1\n").find("goes on after the last row"),
              std::string::npos);
    EXPECT_NE(refusal("1 1 1\n-1 0 0\n1 1\n1\n").find("line 2: lambda is negative"), std::string::npos);
    EXPECT_NE(refusal("2 2.5 3\n").find("line 1: '2.5'"), std::string::npos);
    EXPECT_NE(refusal("0 2 3\n").find("must be at least 1"), std::string::npos);
    EXPECT_NE(refusal("").find("truncated"), std::string::npos);
}

TEST_F(ProblemFileTest, AHeaderCannotAskForMoreThanTheFileHolds) {
    EXPECT_NE(refusal("1000000 1000000 1000000\n1 1 1\n1 1\n").find("too short"), std::string::npos);
    EXPECT_NE(refusal("9223372036854775807 9223372036854775807 2\n1 1 1\n1 1\n").find("too short"),
              std::string::npos);
}

TEST_F(ProblemFileTest, MissingFilesAndFoldersAreRefused) {
    EXPECT_THROW(read_problem_file("/nonexistent/problem.txt"), Error);
    EXPECT_THROW(read_problem_file(std::filesystem::temp_directory_path().string()), Error);
}

}  // namespace
}  // namespace coseg
