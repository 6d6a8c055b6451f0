#include "src/parallel/comm.hpp"

#include <gtest/gtest.h>

#include <cstring>

namespace coseg {
namespace {

TEST(Agree, EveryRankThrowsTheErrorOfTheLowestFailingRank) {
    const Comm comm(MPI_COMM_WORLD);
    const int last = comm.size() - 1;
    try {
        agree(comm, [&] {
            if (comm.rank() == last) throw Error(ExitCode::input, "bad file on rank " + std::to_string(last));
        });
        FAIL() << "no throw";
    } catch (const AgreedError& error) {
        EXPECT_EQ(error.code(), ExitCode::input);
        EXPECT_EQ(std::string(error.what()), "bad file on rank " + std::to_string(last));
    }
}

TEST(Agree, PassesWhereNoRankFails) {
    const Comm comm(MPI_COMM_WORLD);
    EXPECT_NO_THROW(agree(comm, [] {}));
}

TEST(AllGather, ConcatenatesInRankOrder) {
    const Comm comm(MPI_COMM_WORLD);
    const std::vector<int> mine(static_cast<std::size_t>(comm.rank()), comm.rank());
    std::vector<int> expected;
    for (int r = 0; r < comm.size(); ++r) expected.insert(expected.end(), static_cast<std::size_t>(r), r);
    EXPECT_EQ(all_gather(comm, std::span<const int>(mine)), expected);
}

TEST(AllGather, GivesTheSameInMessagesOfAnyLength) {
    const Comm comm(MPI_COMM_WORLD);
    std::vector<std::int64_t> mine;
    for (int k = 0; k < 5 + 3 * comm.rank(); ++k) mine.push_back(100 * comm.rank() + k);
    const std::span<const std::int64_t> local(mine);
    const std::vector<std::int64_t> whole = all_gather(comm, local);
    EXPECT_EQ(std::ssize(whole), 5 * comm.size() + 3 * comm.size() * (comm.size() - 1) / 2);
    for (const std::int64_t longest : {1, 3, 5, 1000}) EXPECT_EQ(all_gather(comm, local, longest), whole);
    const std::span<const std::byte> bytes = std::as_bytes(local);
    const std::vector<std::byte> all_bytes = all_gather_bytes(comm, bytes);
    ASSERT_EQ(all_bytes.size(), whole.size() * sizeof(std::int64_t));
    EXPECT_EQ(std::memcmp(all_bytes.data(), whole.data(), all_bytes.size()), 0);
    for (const std::int64_t longest : {7, 64, 100000}) {
        EXPECT_EQ(all_gather_bytes(comm, bytes, longest), all_bytes);
        EXPECT_EQ(gather_bytes(comm, bytes, longest), comm.is_root() ? all_bytes : std::vector<std::byte>{});
        std::vector<std::byte> told = comm.is_root() ? all_bytes : std::vector<std::byte>{};
        broadcast_bytes(comm, told, longest);
        EXPECT_EQ(told, all_bytes);
    }
}

TEST(AnyRank, HearsOneRankAmongAll) {
    const Comm comm(MPI_COMM_WORLD);
    const bool last = comm.rank() == comm.size() - 1;
    EXPECT_TRUE(any_rank(comm, last));
    EXPECT_FALSE(any_rank(comm, false));
    EXPECT_TRUE(every_rank(comm, true));
    EXPECT_EQ(every_rank(comm, last), comm.size() == 1);
}

TEST(InMessages, CoverValuesBeyondTheRangeOfInt) {
    constexpr std::int64_t total = 5'000'000'000;
    std::int64_t next = 0;
    int messages = 0;
    in_messages(total, [&](std::int64_t first, int count) {
        EXPECT_EQ(first, next);
        next = first + count;
        ++messages;
    });
    EXPECT_EQ(next, total);
    EXPECT_EQ(messages, 3);
    in_messages(0, [](std::int64_t, int) { FAIL() << "nothing is sent"; });
}

}  // namespace
}  // namespace coseg
