#include "solvers/spectral/served_product.hpp"

#include <gtest/gtest.h>

#include "src/base/error.hpp"
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

/// What the root gets for `x`; empty on the others.
std::vector<double> multiply(const Comm& comm, const SparseRows& complete, const std::vector<double>& x) {
    const SparseRows mine = testing_graphs::owned_rows(comm, complete);
    ServedProduct product(comm, mine);
    if (!comm.is_root()) {
        product.serve();
        return {};
    }
    const ServedProduct::Release release(product);
    std::vector<double> y(x.size());
    const PetscMatrix matrix = shell_matrix(product);
    PetscVector from, to;
    check(MatCreateVecs(matrix.get(), from.out(), to.out()), "MatCreateVecs");
    for (std::size_t i = 0; i < x.size(); ++i)
        check(VecSetValue(from.get(), static_cast<PetscInt>(i), x[i], INSERT_VALUES), "VecSetValue");
    check(MatMult(matrix.get(), from.get(), to.get()), "MatMult");
    const PetscScalar* values = nullptr;
    check(VecGetArrayRead(to.get(), &values), "VecGetArrayRead");
    y.assign(values, values + x.size());
    check(VecRestoreArrayRead(to.get(), &values), "VecRestoreArrayRead");
    return y;
}

class ServedProductOf : public testing::TestWithParam<int> {};

TEST_P(ServedProductOf, HasTheSameBytesAsOnOneRank) {
    const Comm comm(MPI_COMM_WORLD);
    const Comm self(MPI_COMM_SELF);
    const SparseRows complete = random_graph(GetParam());
    std::vector<double> x;
    for (int i = 0; i < GetParam(); ++i)
        x.push_back(uniform_of(hash_words({5, static_cast<std::uint64_t>(i)})));
    const std::vector<double> shared = multiply(comm, complete, x);
    if (!comm.is_root()) return;
    EXPECT_EQ(shared, multiply(self, complete, x));
    for (std::size_t r = 0; r < x.size(); ++r) {
        double expected = 0.0;
        for (auto k = static_cast<std::size_t>(complete.offsets[r]);
             k < static_cast<std::size_t>(complete.offsets[r + 1]); ++k) {
            expected += complete.values[k] * x[static_cast<std::size_t>(complete.columns[k])];
        }
        EXPECT_NEAR(shared[r], expected, 1e-14);
    }
}

// 5: one rank owns everything; 70: uneven tiles; 301: several tiles on each of 4 ranks.
INSTANTIATE_TEST_SUITE_P(Sizes, ServedProductOf, testing::Values(5, 70, 301));

TEST(ServedProductFailure, OfTheRootLetsTheOthersGo) {
    const Comm comm(MPI_COMM_WORLD);
    const SparseRows mine = testing_graphs::owned_rows(comm, random_graph(70));
    ServedProduct product(comm, mine);
    const auto fail_on_root = [&] {
        if (!comm.is_root()) return product.serve();
        const ServedProduct::Release release(product);
        throw Error(ExitCode::not_converged, "the root gives up");
    };
    EXPECT_THROW(agree(comm, fail_on_root), AgreedError);
}

}  // namespace
}  // namespace coseg
