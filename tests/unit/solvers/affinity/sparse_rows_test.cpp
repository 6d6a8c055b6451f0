#include "solvers/affinity/sparse_rows.hpp"

#include <gtest/gtest.h>

#include <array>

#include "solvers/affinity/graph_components.hpp"

namespace coseg {
namespace {

TEST(SparseRows, EntriesOfOnePlaceAreAddedInAnyOrder) {
    const std::vector<SparseEntry> entries = {
        {1, 2, 0.1}, {0, 1, 5.0}, {1, 0, 7.0}, {1, 2, 0.7}, {1, 2, 0.2}};
    const SparseRows a = rows_from_entries(3, {0, 3}, entries);
    const SparseRows b = rows_from_entries(3, {0, 3}, {entries.rbegin(), entries.rend()});
    EXPECT_EQ(a.offsets, (std::vector<std::int64_t>{0, 1, 3, 3}));
    EXPECT_EQ(a.columns, (std::vector<int>{1, 0, 2}));
    EXPECT_EQ(a.values, (std::vector<double>{5.0, 7.0, 0.1 + 0.2 + 0.7}));
    EXPECT_EQ(a.values, b.values);
}

TEST(SparseRows, WeightedSumLeavesOutTermsOfWeightZero) {
    const SparseRows a = rows_from_entries(2, {0, 2}, {{0, 1, 1.0}, {1, 0, 1.0}});
    const SparseRows b = rows_from_entries(2, {0, 2}, {{0, 0, 3.0}, {0, 1, 2.0}});
    const std::array<WeightedMatrix, 2> both = {{{a, 2.0}, {b, 0.5}}};
    const SparseRows sum = weighted_sum(both);
    EXPECT_EQ(sum.columns, (std::vector<int>{0, 1, 0}));
    EXPECT_EQ(sum.values, (std::vector<double>{1.5, 3.0, 2.0}));
    const std::array<WeightedMatrix, 2> one = {{{a, 2.0}, {b, 0.0}}};
    EXPECT_EQ(weighted_sum(one).values, (std::vector<double>{2.0, 2.0}));
}

TEST(SparseRows, DropsSmallEntriesRowByRow) {
    SparseRows m =
        rows_from_entries(3, {0, 3}, {{0, 1, 1e-7}, {0, 2, 1.0}, {1, 0, 1e-7}, {2, 0, 1.0}, {2, 2, 1e-6}});
    drop_small_entries(m, 1e-6);
    EXPECT_EQ(m.offsets, (std::vector<std::int64_t>{0, 1, 1, 3}));
    EXPECT_EQ(m.columns, (std::vector<int>{2, 0, 2}));
}

TEST(MainComponents, AreLargeEnoughAndNoMoreThanParts) {
    // Sizes 60, 30, 8, 1, 1 of 100; a twentieth of a part's even share is 5 / parts.
    std::vector<int> component;
    for (const auto& [root, size] : {std::pair{0, 60}, {60, 30}, {90, 8}, {98, 1}, {99, 1}}) {
        component.insert(component.end(), static_cast<std::size_t>(size), root);
    }
    EXPECT_EQ(main_components(component, 4).size(), 3U);
    EXPECT_EQ(main_components(component, 2).size(), 2U);
    EXPECT_EQ(main_components(component, 1).size(), 1U);
    EXPECT_EQ(main_components(component, 4)[2].front(), 90);
    EXPECT_TRUE(main_components({0, 1, 2}, 2).empty());
}

TEST(AttachSetAside, SpreadsInRoundsAndFallsBack) {
    // 0 -3- 2 -1- 1, 2 -1- 3 -1- 4; 5 alone. 0 has label 7, 1 has label 8.
    const SparseRows within_mesh_affinity = rows_from_entries(6, {0, 6},
                                                              {{0, 2, 3.0},
                                                               {2, 0, 3.0},
                                                               {2, 1, 1.0},
                                                               {1, 2, 1.0},
                                                               {2, 3, 1.0},
                                                               {3, 2, 1.0},
                                                               {3, 4, 1.0},
                                                               {4, 3, 1.0}});
    std::vector<int> labels = {7, 8, -1, -1, -1, -1};
    EXPECT_EQ(attach_set_aside(labels, within_mesh_affinity, 9), 1);
    EXPECT_EQ(labels, (std::vector<int>{7, 8, 7, 7, 7, 9}));
}

}  // namespace
}  // namespace coseg
