#include "src/parallel/comm.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "src/base/seeded_random.hpp"
#include "src/parallel/block_range.hpp"

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

TEST(FixedPointSum, SameBitsOnAnyNumberOfRanks) {
    const Comm comm(MPI_COMM_WORLD);
    constexpr int n = 1000;
    const auto addend = [](int i) { return normal_of(hash_words({7, static_cast<std::uint64_t>(i)})); };
    FixedPointSum alone(1, 8.0);
    FixedPointSum shared(1, 8.0);
    double plain = 0.0;
    for (int i = 0; i < n; ++i) {
        alone.add(0, addend(i));
        plain += addend(i);
    }
    const BlockRange mine = block_range(n, comm.size(), comm.rank());
    for (auto i = mine.end; i-- > mine.begin;) shared.add(0, addend(static_cast<int>(i)));
    const Comm self(MPI_COMM_SELF);
    EXPECT_EQ(shared.all_sum(comm)[0], alone.all_sum(self)[0]);
    EXPECT_NEAR(shared.all_sum(comm)[0], plain, n * std::ldexp(1.0, 4 - 40));
}

TEST(AllGather, ConcatenatesInRankOrder) {
    const Comm comm(MPI_COMM_WORLD);
    const std::vector<int> mine(static_cast<std::size_t>(comm.rank()), comm.rank());
    std::vector<int> expected;
    for (int r = 0; r < comm.size(); ++r) expected.insert(expected.end(), static_cast<std::size_t>(r), r);
    EXPECT_EQ(all_gather(comm, std::span<const int>(mine)), expected);
}

}  // namespace
}  // namespace coseg
