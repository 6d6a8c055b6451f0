#include "solvers/subspace/column_assembly.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "src/base/index.hpp"
#include "tests/support/graphs.hpp"
#include "tests/support/subspace_problems.hpp"

namespace coseg {
namespace {

using testing_graphs::random_coefficients;

TEST(Coefficients, OfAllRanksAreThoseOfOne) {
    const Comm comm(MPI_COMM_WORLD);
    const SparseCoefficients whole = random_coefficients(Comm(MPI_COMM_SELF), 100, 3, 6, 11);
    const SparseCoefficients mine = random_coefficients(comm, 100, 3, 6, 11);
    expect_same_coefficients(all_gathered(comm, mine), whole);
    const SparseCoefficients root = gathered(comm, mine);
    if (comm.is_root())
        expect_same_coefficients(root, whole);
    else
        EXPECT_TRUE(root.rows.empty() && root.values.empty());
}

/// Items `first`, `first` + `step`, ...: `count` of them.
std::vector<int> items(int first, int step, int count) {
    std::vector<int> all;
    for (int k = 0; k < count; ++k) all.push_back(first + step * k);
    return all;
}

/// The assembly of two solves, by definition: column after column, of those that found it first.
SparseCoefficients assembled(int size, const std::vector<SparseCoefficients>& solves,
                             const std::vector<std::vector<int>>& item_of) {
    SparseCoefficients all;
    all.size = size;
    all.columns = {0, size};
    all.features = solves.front().features;
    all.offsets = {0};
    for (int item = 0; item < size; ++item) {
        for (std::size_t s = 0; s < solves.size() && std::ssize(all.rows) == all.offsets.back(); ++s) {
            const auto found = std::find(item_of[s].begin(), item_of[s].end(), item);
            if (found == item_of[s].end()) continue;
            const auto c = at(found - item_of[s].begin());
            for (std::size_t e = at(solves[s].offsets[c]); e < at(solves[s].offsets[c + 1]); ++e) {
                all.rows.push_back(item_of[s][at(solves[s].rows[e])]);
                for (std::size_t h = 0; h < at(all.features); ++h)
                    all.values.push_back(solves[s].values[e * at(all.features) + h]);
            }
        }
        all.offsets.push_back(std::ssize(all.rows));
    }
    return all;
}

TEST(ColumnAssembly, TakesEachColumnFromTheSolveThatFoundItFirst) {
    const Comm comm(MPI_COMM_WORLD);
    const Comm self(MPI_COMM_SELF);
    constexpr int size = 150;
    // They have items 60, 62, ... 98 in common, and the last items in neither.
    const std::vector<std::vector<int>> item_of = {items(0, 1, 100), items(60, 2, 40)};
    ColumnAssembly assembly(comm, size);
    std::vector<SparseCoefficients> whole;
    for (std::size_t s = 0; s < item_of.size(); ++s) {
        const auto count = static_cast<int>(item_of[s].size());
        const std::uint64_t seed = 7 + s;
        assembly.add(random_coefficients(comm, count, 3, 5, seed), item_of[s]);
        whole.push_back(random_coefficients(self, count, 3, 5, seed));
    }
    const SparseCoefficients mine = assembly.take();
    EXPECT_EQ(mine.columns, block_range(size, comm.size(), comm.rank(), coefficient_tile));
    expect_same_coefficients(all_gathered(comm, mine), assembled(size, whole, item_of));
}

}  // namespace
}  // namespace coseg
