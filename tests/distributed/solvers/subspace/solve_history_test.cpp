#include "solvers/subspace/solve_history.hpp"

#include <gtest/gtest.h>

namespace coseg {
namespace {

/// Tile k has k % 3 + 1 rounds of values that no binary fraction holds.
std::vector<ColumnRound> made_tile(int k) {
    std::vector<ColumnRound> rounds;
    for (int round = 0; round <= k % 3; ++round)
        rounds.push_back({0.1 * k + round / 3.0, 1e6 / (k + 1.0) - round, k + round, 10L * k + round});
    return rounds;
}

TEST(SolveHistory, TilesOfAllRanksAddUpToTheSameBits) {
    const Comm world(MPI_COMM_WORLD);
    constexpr int tiles = 11;
    std::vector<std::vector<ColumnRound>> mine, all;
    for (int k = 0; k < tiles; ++k) {
        all.push_back(made_tile(k));
        // The last rank has none, where there are several.
        if (k % std::max(world.size() - 1, 1) == world.rank()) mine.push_back(made_tile(k));
    }
    const std::vector<ColumnRound> shared = joined_rounds(world, mine);
    EXPECT_EQ(shared, joined_rounds(Comm(MPI_COMM_SELF), all));
    const std::vector<ColumnRound> plain = joined_rounds(all);
    ASSERT_EQ(shared.size(), plain.size());
    for (std::size_t k = 0; k < plain.size(); ++k) {
        EXPECT_NEAR(shared[k].reached, plain[k].reached, 1e-9);
        EXPECT_NEAR(shared[k].bound, plain[k].bound, 1e-9 * plain[k].bound);
        EXPECT_EQ(shared[k].iterations, plain[k].iterations);
        EXPECT_EQ(shared[k].working_pairs, plain[k].working_pairs);
    }
}

}  // namespace
}  // namespace coseg
