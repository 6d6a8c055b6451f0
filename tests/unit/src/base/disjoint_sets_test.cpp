#include "src/base/disjoint_sets.hpp"

#include <gtest/gtest.h>

namespace coseg {
namespace {

TEST(DisjointSets, AreKnownByTheirLowestNumber) {
    DisjointSets sets(6);
    EXPECT_EQ(sets.lowest(5), 5);
    EXPECT_TRUE(sets.join(5, 3));
    EXPECT_TRUE(sets.join(4, 1));
    EXPECT_TRUE(sets.join(4, 5));
    EXPECT_FALSE(sets.join(3, 1));
    for (const int i : {1, 3, 4, 5}) EXPECT_EQ(sets.lowest(i), 1) << i;
    EXPECT_EQ(sets.lowest(0), 0);
    EXPECT_EQ(sets.lowest(2), 2);
}

TEST(DisjointSets, FollowLongChains) {
    constexpr int size = 100'000;
    DisjointSets sets(size);
    for (int i = size - 1; i > 0; --i) sets.join(i, i - 1);
    EXPECT_EQ(sets.lowest(size - 1), 0);
}

}  // namespace
}  // namespace coseg
