#include "src/parallel/shared_counter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "src/parallel/record_exchange.hpp"

namespace coseg {
namespace {

TEST(SharedCounter, HandsOutEveryNumberOnce) {
    const Comm comm(MPI_COMM_WORLD);
    constexpr int items = 500;
    std::vector<int> mine;
    {
        SharedCounter counter(comm);
        for (std::int64_t item = counter.next(); item < items; item = counter.next()) {
            mine.push_back(static_cast<int>(item));
        }
    }
    std::vector<int> all = all_gather(comm, std::span<const int>(mine));
    std::sort(all.begin(), all.end());
    ASSERT_EQ(all.size(), static_cast<std::size_t>(items));
    for (int i = 0; i < items; ++i) EXPECT_EQ(all[static_cast<std::size_t>(i)], i);
}

TEST(Texts, GatherAndBroadcast) {
    const Comm comm(MPI_COMM_WORLD);
    std::vector<std::string> mine;
    for (int k = 0; k < comm.rank(); ++k)
        mine.push_back("rank " + std::to_string(comm.rank()) + (k % 2 != 0 ? "" : " text"));
    const std::vector<std::string> all = all_gather_records(comm, mine);
    EXPECT_EQ(all.size(), static_cast<std::size_t>(comm.size() * (comm.size() - 1) / 2));
    std::vector<std::string> texts;
    if (comm.is_root()) texts = {"a", "", "c d"};
    broadcast(comm, texts);
    EXPECT_EQ(texts, (std::vector<std::string>{"a", "", "c d"}));
}

}  // namespace
}  // namespace coseg
