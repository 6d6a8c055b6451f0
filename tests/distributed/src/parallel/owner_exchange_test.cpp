// Records reach their owners, in the order of the ranks that had them.

#include "src/parallel/owner_exchange.hpp"

#include <gtest/gtest.h>
#include <mpi.h>

namespace coseg {
namespace {

struct Note {
    int from = 0;
    int number = 0;
};

TEST(OwnerExchange, BringsEveryRecordToItsOwnerInOrder) {
    const Comm comm(MPI_COMM_WORLD);
    std::vector<Note> notes;
    for (int k = 0; k < 10 + comm.rank(); ++k) notes.push_back({comm.rank(), k});
    const std::vector<Note> mine = sent_to_owners(
        comm, notes, [&](const Note& n) { return (n.from + n.number) % comm.size(); }, "notes");
    std::vector<std::pair<int, int>> expected;
    for (int rank = 0; rank < comm.size(); ++rank) {
        for (int k = 0; k < 10 + rank; ++k) {
            if ((rank + k) % comm.size() == comm.rank()) expected.emplace_back(rank, k);
        }
    }
    ASSERT_EQ(mine.size(), expected.size());
    for (std::size_t k = 0; k < mine.size(); ++k)
        EXPECT_EQ(std::pair(mine[k].from, mine[k].number), expected[k]) << k;
}

TEST(OwnerExchange, BringsNothingWhereThereIsNothing) {
    const Comm comm(MPI_COMM_WORLD);
    EXPECT_TRUE(sent_to_owners(
                    comm, std::vector<Note>{}, [](const Note&) { return 0; }, "notes")
                    .empty());
}

TEST(OwnerExchange, RefusesOnAllRanksWhatOneOfThemCannotCount) {
    const Comm comm(MPI_COMM_WORLD);
    std::vector<std::int64_t> outgoing(static_cast<std::size_t>(comm.size()), 1);
    if (comm.rank() == comm.size() - 1) outgoing.front() = std::int64_t{1} << 31;
    EXPECT_THROW(owner_counts(comm, outgoing, "notes"), AgreedError);
}

}  // namespace
}  // namespace coseg
