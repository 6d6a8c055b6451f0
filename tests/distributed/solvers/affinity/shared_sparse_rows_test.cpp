#include "solvers/affinity/shared_sparse_rows.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <vector>

#include "src/base/seeded_random.hpp"

namespace coseg {
namespace {

/// Rows `range` of a random matrix, in which some rows, and with few columns many, are empty.
SparseRows random_rows(std::int64_t size, BlockRange range) {
    std::vector<SparseEntry> entries;
    for (auto i = range.begin; i < range.end; ++i) {
        SeededStream random(hash_words({static_cast<std::uint64_t>(size), static_cast<std::uint64_t>(i)}));
        for (std::int64_t j = 0; j < size; ++j) {
            if (random.uniform() < 0.05)
                entries.push_back({static_cast<int>(i), static_cast<int>(j), random.uniform()});
        }
    }
    return rows_from_entries(size, range, entries);
}

template <class Values, class Expected>
void expect_same(const Values& values, const Expected& expected) {
    EXPECT_TRUE(std::equal(values.begin(), values.end(), expected.begin(), expected.end()));
}

void expect_all_rows(const Comm& comm) {
    for (const std::int64_t size : {1, 20, 33, 200}) {  // 32 rows belong together: some ranks have none
        const BlockRange own = block_range(size, comm.size(), comm.rank(), row_tile);
        const SharedSparseRows rows(comm, random_rows(size, own));
        const SparseRows expected = random_rows(size, {0, size});
        const SparseRowsView view = rows.view();
        EXPECT_EQ(view.size, size);
        EXPECT_EQ(view.rows, expected.rows);
        expect_same(view.offsets, expected.offsets);
        expect_same(view.columns, expected.columns);
        expect_same(view.values, expected.values);
    }
}

TEST(SharedSparseRows, HaveAllRowsOnEveryNode) {
    const Comm comm(MPI_COMM_WORLD);
    expect_all_rows(comm);
    for (const char* ranks : {"1", "2"}) {
        setenv("COSEG_RANKS_PER_NODE", ranks, 1);
        expect_all_rows(comm);
    }
    unsetenv("COSEG_RANKS_PER_NODE");
}

TEST(SharedSparseRows, OrTheRowsOfARankThatCopiesKeep) {
    const SparseRows own = random_rows(50, {10, 30});
    SharedSparseRows copy;
    EXPECT_EQ(copy.view().size, 0);
    EXPECT_EQ(copy.view().local_rows(), 0);
    {
        const SharedSparseRows rows{SparseRows(own)};
        copy = rows;
    }
    EXPECT_EQ(copy.view().rows, own.rows);
    expect_same(copy.view().columns, own.columns);
    expect_same(copy.view().values, own.values);
}

}  // namespace
}  // namespace coseg
