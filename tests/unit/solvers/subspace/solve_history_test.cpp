#include "solvers/subspace/solve_history.hpp"

#include <gtest/gtest.h>

namespace coseg {
namespace {

TEST(SolveHistory, ThinsOutFromTheFrontAndKeepsTheLastRows) {
    SolveHistory history;
    const int count = 10000;
    for (int pass = 1; pass <= count; ++pass) append_row(history, {.pass = pass, .iterations = 10 * pass});
    EXPECT_LE(history.size(), most_history_rows);
    EXPECT_GE(history.size(), most_history_rows / 2);
    EXPECT_EQ(history.front().pass, 1);
    for (std::size_t k = 1; k < history.size(); ++k) {
        EXPECT_GT(history[k].pass, history[k - 1].pass);
        EXPECT_EQ(history[k].iterations, 10 * history[k].pass);
    }
    EXPECT_EQ(history.back().pass, count);
    EXPECT_EQ(history[history.size() - 2].pass, count - 1);
}

TEST(SolveHistory, ShortOnesAreKeptWhole) {
    SolveHistory history;
    for (int pass = 1; pass <= static_cast<int>(most_history_rows); ++pass)
        append_row(history, {.pass = pass});
    EXPECT_EQ(history.size(), most_history_rows);
    EXPECT_EQ(history[1].pass, 2);
}

TEST(SolveHistory, SeveralProblemsAddUpAndTheShorterStaysAtItsLastRow) {
    const SolveHistory one = {{1, 0, 10.0, 1.0, 0.9, 5}, {2, 7, 6.0, 5.0, 0.1, 8}};
    const SolveHistory other = {{1, 3, 4.0, 3.0, 0.25, 2}};
    const SolveHistory sum = joined({one, {}, other});
    const SolveHistory expected = {{1, 3, 14.0, 4.0, 0.9, 7}, {2, 7, 10.0, 8.0, 0.25, 10}};
    EXPECT_EQ(sum, expected);
    EXPECT_TRUE(joined({}).empty());
}

TEST(SolveHistory, ColumnsAddUpRoundByRound) {
    const std::vector<std::vector<ColumnRound>> columns = {
        {{0.0, 4.0, 0, 0}, {2.0, 3.0, 9, 6}}, {{1.0, 1.0, 2, 1}}, {}};
    const std::vector<ColumnRound> expected = {{1.0, 5.0, 2, 1}, {3.0, 4.0, 9, 7}};
    EXPECT_EQ(joined_rounds(columns), expected);
}

TEST(SolveHistory, LateRoundsOfAColumnReplaceTheLast) {
    std::vector<ColumnRound> rounds;
    for (int k = 0; k < 1000; ++k) append_round(rounds, {.iterations = k});
    ASSERT_EQ(rounds.size(), most_history_rows);
    EXPECT_EQ(rounds.front().iterations, 0);
    EXPECT_EQ(rounds.back().iterations, 999);
}

}  // namespace
}  // namespace coseg
