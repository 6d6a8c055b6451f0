#include "solvers/spectral/row_product.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <span>

#include "src/base/seeded_random.hpp"
#include "tests/support/graphs.hpp"

namespace coseg {
namespace {

SparseRows random_graph(int size) {
    SeededStream random(hash_words({31, static_cast<std::uint64_t>(size)}));
    std::vector<testing_graphs::Edge> edges;
    for (int i = 0; i + 1 < size; ++i) edges.push_back({i, i + 1, random.uniform()});
    for (int i = 0; i + 7 < size; i += 3) edges.push_back({i, i + 7, random.uniform()});
    return testing_graphs::graph(size, edges);
}

/// Groups of three rows that follow one another, and one of rows from everywhere.
GroupBalance scattered_balance(int size) {
    GroupBalance balance{0.4, {}, {}};
    for (int i = 0; i < size; ++i) {
        balance.group.push_back(i % 5 == 0 ? 0 : 1 + i / 3);
        balance.indicator.push_back(uniform_of(hash_words({8, static_cast<std::uint64_t>(i)})));
    }
    return balance;
}

std::vector<double> multiplied(const Comm& comm, const SparseRows& complete, const GroupBalance& balance,
                               const std::vector<double>& x) {
    const RowProduct product(comm, testing_graphs::owned_rows(comm, complete), balance);
    PetscVector from, to;
    check(MatCreateVecs(product.matrix(), from.out(), to.out()), "MatCreateVecs");
    PetscInt begin = 0;
    PetscInt end = 0;
    check(VecGetOwnershipRange(from.get(), &begin, &end), "VecGetOwnershipRange");
    for (PetscInt i = begin; i < end; ++i)
        check(VecSetValue(from.get(), i, x[static_cast<std::size_t>(i)], INSERT_VALUES), "VecSetValue");
    check(VecAssemblyBegin(from.get()), "VecAssemblyBegin");
    check(VecAssemblyEnd(from.get()), "VecAssemblyEnd");
    check(MatMult(product.matrix(), from.get(), to.get()), "MatMult");
    check(MatMult(product.matrix(), from.get(), to.get()), "MatMult");
    EXPECT_EQ(product.count(), 2);
    const PetscScalar* values = nullptr;
    check(VecGetArrayRead(to.get(), &values), "VecGetArrayRead");
    std::vector<double> y =
        all_gather(comm, std::span<const double>(values, static_cast<std::size_t>(end - begin)));
    check(VecRestoreArrayRead(to.get(), &values), "VecRestoreArrayRead");
    return y;
}

class RowProductOf : public testing::TestWithParam<int> {
  protected:
    void compare(const GroupBalance& balance) {
        const Comm comm(MPI_COMM_WORLD);
        const Comm self(MPI_COMM_SELF);
        const SparseRows complete = random_graph(GetParam());
        const auto size = static_cast<std::size_t>(GetParam());
        std::vector<double> x;
        for (std::size_t i = 0; i < size; ++i) x.push_back(uniform_of(hash_words({5, i})));
        std::vector<double> expected(size, 0.0);
        for (std::size_t r = 0; r < size; ++r) {
            for (auto k = static_cast<std::size_t>(complete.offsets[r]);
                 k < static_cast<std::size_t>(complete.offsets[r + 1]); ++k) {
                expected[r] += complete.values[k] * x[static_cast<std::size_t>(complete.columns[k])];
            }
            for (std::size_t i = 0; i < balance.group.size(); ++i) {
                if (balance.group[i] == balance.group[r])
                    expected[r] -= balance.weight * balance.indicator[r] * balance.indicator[i] * x[i];
            }
        }
        const std::vector<double> y = multiplied(comm, complete, balance, x);
        EXPECT_EQ(y, multiplied(self, complete, balance, x));
        for (std::size_t r = 0; r < size; ++r) EXPECT_NEAR(y[r], expected[r], 1e-13);
    }
};

TEST_P(RowProductOf, HasTheSameBytesAsOnOneRank) { compare({}); }
TEST_P(RowProductOf, AlsoWithGroupsThatLieOnSeveralRanks) { compare(scattered_balance(GetParam())); }

// 5: one rank owns everything; 70: uneven tiles; 301: several tiles on each of 4 ranks.
INSTANTIATE_TEST_SUITE_P(Sizes, RowProductOf, testing::Values(5, 70, 301));

}  // namespace
}  // namespace coseg
