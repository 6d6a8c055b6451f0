#include "solvers/oversegmentation/merge_queue.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>

#include "src/base/seeded_random.hpp"

namespace coseg {
namespace {

using Candidates = std::map<int, MergeCandidate>;  // by owner

MergeCandidate best_of(const Candidates& candidates) {
    const auto best =
        std::min_element(candidates.begin(), candidates.end(),
                         [](const auto& x, const auto& y) { return is_better(x.second, y.second); });
    return best->second;
}

/// A candidate of `owner` with another group; changes are few, so that many tie.
MergeCandidate random_candidate(int owner, int groups, std::uint64_t step) {
    const auto random = [&](std::uint64_t k) { return uniform_of(hash_words({step, k})); };
    const int other = (owner + 1 + static_cast<int>(random(1) * (groups - 1))) % groups;
    return {.change = static_cast<double>(static_cast<int>(8.0 * random(2))),
            .group_a = std::min(owner, other),
            .group_b = std::max(owner, other),
            .owner = owner};
}

class MergeQueueOfGroups : public testing::TestWithParam<int> {};

TEST_P(MergeQueueOfGroups, ItsTopIsTheBestOfAllCandidates) {
    const int groups = GetParam();
    MergeQueue queue(groups);
    Candidates known;
    EXPECT_TRUE(queue.empty());
    for (std::uint64_t step = 0; step < 4000; ++step) {
        const auto random = [&](std::uint64_t k) { return uniform_of(hash_words({step, k, 7})); };
        const int owner = std::min(groups - 1, static_cast<int>(random(0) * groups));
        if (random(1) < 0.6) {
            const MergeCandidate candidate = random_candidate(owner, groups, step);
            queue.set(candidate);
            known[owner] = candidate;
        } else {
            queue.remove(owner);
            known.erase(owner);
        }
        ASSERT_EQ(queue.empty(), known.empty());
        if (known.empty()) continue;
        const MergeCandidate best = best_of(known);
        EXPECT_EQ(queue.top().change, best.change);
        EXPECT_EQ(queue.top().group_a, best.group_a);
        EXPECT_EQ(queue.top().group_b, best.group_b);
    }
}

INSTANTIATE_TEST_SUITE_P(Groups, MergeQueueOfGroups, testing::Values(2, 5, 17, 200));

TEST(MergeQueue, EmptiesInOrder) {
    MergeQueue queue(50);
    for (int owner = 0; owner < 50; ++owner)
        queue.set(random_candidate(owner, 50, static_cast<std::uint64_t>(owner)));
    MergeCandidate last = queue.top();
    while (!queue.empty()) {
        const MergeCandidate top = queue.top();
        EXPECT_FALSE(is_better(top, last));
        queue.remove(top.owner);
        last = top;
    }
}

}  // namespace
}  // namespace coseg
