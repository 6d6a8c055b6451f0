#include "src/parallel/comm.hpp"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace coseg
