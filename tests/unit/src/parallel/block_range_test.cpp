#include "src/parallel/block_range.hpp"

#include <gtest/gtest.h>

namespace coseg {
namespace {

TEST(BlockRange, CoversEveryItemOnceAndOwnerIsItsInverse) {
    for (const std::int64_t tile : {1, 3, 32}) {
        for (const int ranks : {1, 2, 3, 4, 7, 64}) {
            for (const std::int64_t n : {0, 1, 2, 5, 31, 32, 33, 64, 100, 1000}) {
                std::int64_t next = 0;
                for (int rank = 0; rank < ranks; ++rank) {
                    const BlockRange mine = block_range(n, ranks, rank, tile);
                    ASSERT_EQ(mine.begin, next);
                    ASSERT_LE(mine.begin, mine.end);
                    next = mine.end;
                    for (std::int64_t i = mine.begin; i < mine.end; ++i) {
                        ASSERT_EQ(block_owner(n, ranks, i, tile), rank) << n << " " << ranks << " " << tile;
                    }
                }
                ASSERT_EQ(next, n);
            }
        }
    }
}

TEST(BlockRange, WorkedExampleOfTheHeader) {
    EXPECT_EQ(block_range(10, 3, 0, 2), (BlockRange{0, 4}));
    EXPECT_EQ(block_range(10, 3, 1, 2), (BlockRange{4, 8}));
    EXPECT_EQ(block_range(10, 3, 2, 2), (BlockRange{8, 10}));
}

TEST(BlockRange, TilesAreNeverSplit) {
    for (int rank = 0; rank < 4; ++rank) {
        const BlockRange mine = block_range(1000, 4, rank, 32);
        EXPECT_EQ(mine.begin % 32, 0);
    }
}

}  // namespace
}  // namespace coseg
