#include "src/records/number_runs.hpp"

#include <gtest/gtest.h>

namespace coseg {
namespace {

TEST(NumberRuns, TellAscendingNumbersByWhereTheyBeginAndEnd) {
    EXPECT_EQ(ranges_of({}), std::vector<NumberRange>{});
    const std::vector<NumberRange> ranges = ranges_of({0, 1, 2, 7, 9, 10});
    EXPECT_EQ(ranges, (std::vector<NumberRange>{{0, 2}, {7, 7}, {9, 10}}));
    for (const int inside : {0, 1, 2, 7, 9, 10}) EXPECT_TRUE(contains(ranges, inside)) << inside;
    for (const int outside : {-1, 3, 6, 8, 11}) EXPECT_FALSE(contains(ranges, outside)) << outside;
    EXPECT_FALSE(contains({}, 0));
}

TEST(NumberRuns, HaveTheirLabelsAgain) {
    const std::vector<int> labels = {4, 4, 0, 4};
    EXPECT_EQ(runs_of(labels), (std::vector<LabelRun>{{4, 2}, {0, 1}, {4, 1}}));
    EXPECT_EQ(labels_of(runs_of(labels)), labels);
    EXPECT_TRUE(runs_of({}).empty());
}

TEST(NumberRuns, CountWithoutMemoryForEachLabel) {
    EXPECT_EQ(label_count({{0, 2'000'000'000}, {1, 2'000'000'000}}), 4'000'000'000);
}

}  // namespace
}  // namespace coseg
