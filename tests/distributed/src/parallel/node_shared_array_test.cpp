#include "src/parallel/node_shared_array.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include "src/parallel/block_range.hpp"

namespace coseg {
namespace {

/// Every rank writes its block of the node's array and must then read those of the others.
void expect_shared(NodeSharedArray<std::int64_t>& array) {
    const Comm& here = array.ranks().here();
    for (std::size_t i = 0; i < array.size(); ++i) ASSERT_EQ(array.data()[i], 0) << i;
    array.fence();
    for (std::int64_t round = 1; round < 20; ++round) {
        const BlockRange own = block_range(static_cast<std::int64_t>(array.size()), here.size(), here.rank());
        for (std::int64_t i = own.begin; i < own.end; ++i) array.data()[i] = round * i;
        array.fence();
        for (std::size_t i = 0; i < array.size(); ++i)
            ASSERT_EQ(array.data()[i], round * static_cast<std::int64_t>(i));
        array.fence();
    }
}

TEST(NodeRanks, AreThoseOfThisMachine) {
    const Comm world(MPI_COMM_WORLD);
    const NodeRanks ranks(world);
    EXPECT_EQ(ranks.node_count(), 1);
    EXPECT_EQ(ranks.here().size(), world.size());
    EXPECT_EQ(ranks.here().rank(), world.rank());
    EXPECT_EQ(ranks.nodes_on_machine(), 1);
    EXPECT_EQ(ranks.any_shared(), world.size() > 1);
}

TEST(NodeRanks, OfNodesThatAreNone) {
    const Comm world(MPI_COMM_WORLD);
    const NodeRanks ranks(world, world.rank() % 3);  // at 4 ranks: 0 and 3, 1, 2
    EXPECT_EQ(ranks.node_count(), std::min(world.size(), 3));
    EXPECT_EQ(ranks.nodes_on_machine(), ranks.node_count());
    for (int r = 0; r < world.size(); ++r) {
        EXPECT_EQ(ranks.node_of(r) == ranks.node_of(world.rank()), r % 3 == world.rank() % 3);
    }
    if (ranks.here().is_root()) {
        EXPECT_EQ(ranks.leaders().size(), ranks.node_count());
        EXPECT_EQ(ranks.leaders().rank(), ranks.node_of(world.rank()));
    }
    EXPECT_FALSE(ranks.apart().any_shared());
    EXPECT_EQ(ranks.apart().node_of(world.size() - 1), world.size() - 1);
}

TEST(NodeRanks, TheEnvironmentMayLimitThem) {
    const Comm world(MPI_COMM_WORLD);
    setenv("COSEG_RANKS_PER_NODE", "2", 1);
    const NodeRanks pairs(world);
    setenv("COSEG_RANKS_PER_NODE", "none", 1);
    const NodeRanks ranks(world);
    unsetenv("COSEG_RANKS_PER_NODE");
    EXPECT_EQ(pairs.node_count(), (world.size() + 1) / 2);
    EXPECT_EQ(pairs.node_of(world.rank()), world.rank() / 2);
    EXPECT_EQ(ranks.node_count(), 1);
}

TEST(NodeSharedArray, WhatOneRankWritesAllReadOnOneNodeAndOnSeveral) {
    const Comm world(MPI_COMM_WORLD);
    NodeSharedArray<std::int64_t> array(world, 1001);
    EXPECT_FALSE(array.fell_back());
    EXPECT_EQ(array.ranks().here().size(), world.size());
    expect_shared(array);
    NodeSharedArray<std::int64_t> of_two(NodeRanks(world, world.rank() / 2), 77);
    EXPECT_EQ(of_two.ranks().node_count(), (world.size() + 1) / 2);
    expect_shared(of_two);
    // A node of one rank beside one of several.
    NodeSharedArray<std::int64_t> uneven(NodeRanks(world, world.rank() == 0 ? 1 : 0), 300);
    EXPECT_EQ(uneven.ranks().here().size(), world.rank() == 0 ? 1 : world.size() - 1);
    expect_shared(uneven);
    NodeSharedArray<std::int64_t> alone(NodeRanks(world, world.rank()), 9);
    expect_shared(alone);
    NodeSharedArray<std::int64_t> empty(world, 0);
    expect_shared(empty);
}

TEST(NodeSharedArray, BeginsAtTheSameAlignmentOnAllRanks) {
    const Comm world(MPI_COMM_WORLD);
    for (const std::size_t size : {1U, 13U, 4097U}) {
        const NodeSharedArray<float> array(world, size);
        EXPECT_EQ(reinterpret_cast<std::uintptr_t>(array.data()) % 64, 0U);
    }
}

TEST(NodeSharedArray, ACopyForEachRankWhereSharedMemoryIsTooSmall) {
    const Comm world(MPI_COMM_WORLD);
    // One node of two without room is enough for all to do without.
    NodeSharedArray<std::int64_t> array(NodeRanks(world, world.rank() % 2), 500,
                                        world.rank() == 0 ? 1000 : shared_memory_room());
    EXPECT_EQ(array.fell_back(), world.size() > 2);  // at 2 ranks there is nobody to share with
    EXPECT_EQ(array.ranks().node_count(), world.size());
    expect_shared(array);
    NodeSharedArray<float> large(NodeRanks(world), std::size_t{1} << 20, std::uint64_t{6} << 20);
    EXPECT_EQ(large.fell_back(), world.size() > 1);
    large.data()[7] = static_cast<float>(world.rank());
    large.fence();
    EXPECT_EQ(large.data()[7], static_cast<float>(world.rank()));
}

}  // namespace
}  // namespace coseg
