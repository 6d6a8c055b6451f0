#include "src/parallel/node_blocks.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace coseg {
namespace {

/// Blocks of 0, 3, 6, ... values, which each rank writes for itself and must then read of the others.
void expect_all_blocks(NodeRanks ranks) {
    const Comm world(MPI_COMM_WORLD);
    std::vector<std::int64_t> ends;
    for (int r = 0; r < world.size(); ++r) ends.push_back((ends.empty() ? 0 : ends.back()) + 3 * r);
    NodeSharedArray<int> array(std::move(ranks), at(ends.back()));
    for (std::int64_t i = ends[at(world.rank())] - 3 * world.rank(); i < ends[at(world.rank())]; ++i)
        array.data()[i] = static_cast<int>(100 + i);
    share_blocks(array, ends);
    for (std::size_t i = 0; i < array.size(); ++i) EXPECT_EQ(array.data()[i], 100 + static_cast<int>(i));
    array.fence();
}

TEST(NodeBlocks, AreOnEveryNodeInTheEnd) {
    const Comm world(MPI_COMM_WORLD);
    expect_all_blocks(NodeRanks(world));
    expect_all_blocks(NodeRanks(world).apart());
    expect_all_blocks(NodeRanks(world, world.rank() % 2));  // whose blocks are not next to each other
    expect_all_blocks(NodeRanks(world, world.rank() / 2));
}

}  // namespace
}  // namespace coseg
