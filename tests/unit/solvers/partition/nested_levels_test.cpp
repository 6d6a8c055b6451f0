#include "solvers/partition/nested_levels.hpp"

#include <gtest/gtest.h>

#include "solvers/partition/partition_agreement.hpp"

namespace coseg {
namespace {

const std::vector<double> ones = {1, 1, 1, 1, 1, 1, 1, 1};

TEST(AdjustedRandIndex, IsOneForTheSamePartitionAndAboutZeroForUnrelatedOnes) {
    const std::vector<int> a = {0, 0, 0, 0, 1, 1, 1, 1};
    const std::vector<int> renamed = {1, 1, 1, 1, 0, 0, 0, 0};
    const std::vector<int> across = {0, 0, 1, 1, 0, 0, 1, 1};
    EXPECT_DOUBLE_EQ(adjusted_rand_index(common_areas(a, 2, renamed, 2, ones)), 1.0);
    EXPECT_NEAR(adjusted_rand_index(common_areas(a, 2, across, 2, ones)), 0.0, 1e-12);
    EXPECT_DOUBLE_EQ(adjusted_rand_index(Eigen::MatrixXd::Constant(1, 1, 3.0)), 1.0);
}

TEST(AdjustedRandIndex, CountsPairsOfPointsByTheirArea) {
    // Areas 1, 2 and 3 of 6; pairs in the same part: 9 + 9 and 1 + 25 of 36, in both 1 + 4 + 9.
    const Eigen::MatrixXd common = common_areas({0, 0, 1}, 2, {0, 1, 1}, 2, {1.0, 2.0, 3.0});
    EXPECT_EQ(common, (Eigen::MatrixXd(2, 2) << 1.0, 2.0, 0.0, 3.0).finished());
    const double expected = 18.0 / 36.0 * 26.0 / 36.0;
    EXPECT_NEAR(adjusted_rand_index(common), (14.0 / 36.0 - expected) / (22.0 / 36.0 - expected), 1e-12);
}

TEST(NestedLevels, UnitesThePartsThatTheCoarserGuideHasInOne) {
    const std::vector<int> parts = {0, 0, 1, 1, 2, 2, 3, 3};
    const PartitionsByNumber guides = {{0, 0, 1, 1, 1, 1, 0, 0}, {0, 0, 1, 1, 2, 2, 0, 0}};
    const PartitionsByNumber levels = nested_levels(parts, 4, guides, ones);
    ASSERT_EQ(levels.size(), 3U);
    EXPECT_EQ(levels[2], parts);
    EXPECT_EQ(levels[1], (std::vector<int>{0, 0, 1, 1, 2, 2, 0, 0}));
    EXPECT_EQ(levels[0], (std::vector<int>{0, 0, 1, 1, 1, 1, 0, 0}));
}

TEST(NestedLevels, WeighsAllLevelsTogether) {
    // The guide of 3 parts would unite 0 and 1 first, but by little; that of 2 parts says that they
    // never are one.
    const std::vector<int> parts = {0, 0, 1, 1, 2, 2, 3, 3};
    const std::vector<double> uneven = {1.0, 1.1, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0};
    const PartitionsByNumber guides = {{0, 0, 1, 1, 0, 0, 1, 1}, {0, 0, 0, 1, 1, 1, 2, 2}};
    const PartitionsByNumber levels = nested_levels(parts, 4, guides, uneven);
    ASSERT_EQ(levels.size(), 3U);
    EXPECT_EQ(levels[0], guides[0]);
}

TEST(NestedLevels, CutsFinerLevelsAsTheFinerGuidesDo) {
    const std::vector<int> parts = {0, 0, 0, 0, 1, 1, 1, 1};
    const PartitionsByNumber guides = {
        {}, {0, 0, 0, 0, 1, 1, 2, 2}, {3, 0, 0, 0, 1, 1, 2, 2}, {3, 0, 0, 0, 1, 1, 2, 4}};
    const PartitionsByNumber levels = nested_levels(parts, 2, guides, ones);
    ASSERT_EQ(levels.size(), 4U);
    EXPECT_EQ(levels[0], parts);
    for (std::size_t k = 1; k < 4; ++k)
        EXPECT_DOUBLE_EQ(adjusted_rand_index(common_areas(levels[k], static_cast<int>(k) + 2, guides[k],
                                                          static_cast<int>(k) + 2, ones)),
                         1.0);
}

TEST(NestedLevels, AreNoneWhereACoarserGuideIsMissing) {
    EXPECT_TRUE(nested_levels({0, 1, 2}, 3, {}, {1, 1, 1}).empty());
    EXPECT_TRUE(nested_levels({0, 0, 0}, 1, {{0, 1, 1}}, {1, 1, 1}).empty());
    EXPECT_EQ(nested_levels({0, 1, 1}, 2, {}, {1, 1, 1}).size(), 1U) << "finer ones may be";
}

}  // namespace
}  // namespace coseg
