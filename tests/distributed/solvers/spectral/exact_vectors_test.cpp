#include "solvers/spectral/exact_vectors.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <span>
#include <vector>

#include "src/base/seeded_random.hpp"

namespace coseg {
namespace {

/// Entries of many orders of magnitude and both signs, by global place.
double entry(int column, std::int64_t row) {
    const auto hash = [&](std::uint64_t what) {
        return uniform_of(
            hash_words({what, static_cast<std::uint64_t>(column), static_cast<std::uint64_t>(row)}));
    };
    return (hash(1) - 0.5) * std::pow(10.0, 12.0 * hash(2) - 6.0);
}

PetscVector filled(const Comm& comm, std::int64_t size, int column) {
    PetscVector vector = exact_vector(comm, size);
    PetscInt begin = 0;
    PetscInt end = 0;
    check(VecGetOwnershipRange(vector.get(), &begin, &end), "VecGetOwnershipRange");
    for (PetscInt i = begin; i < end; ++i)
        check(VecSetValue(vector.get(), i, entry(column, i), INSERT_VALUES), "VecSetValue");
    check(VecAssemblyBegin(vector.get()), "VecAssemblyBegin");
    check(VecAssemblyEnd(vector.get()), "VecAssemblyEnd");
    return vector;
}

std::vector<double> gathered(const Comm& comm, Vec vector) {
    PetscInt rows = 0;
    const PetscScalar* values = nullptr;
    check(VecGetLocalSize(vector, &rows), "VecGetLocalSize");
    check(VecGetArrayRead(vector, &values), "VecGetArrayRead");
    std::vector<double> all =
        all_gather(comm, std::span<const double>(values, static_cast<std::size_t>(rows)));
    check(VecRestoreArrayRead(vector, &values), "VecRestoreArrayRead");
    return all;
}

class ExactVectors : public testing::TestWithParam<int> {
  protected:
    const Comm comm_{MPI_COMM_WORLD};
    const Comm self_{MPI_COMM_SELF};
    /// What `step` makes has the same bits on all ranks as on one.
    void expect_equal(const std::function<std::vector<double>(const Comm&)>& step) {
        EXPECT_EQ(step(comm_), step(self_));
    }
};

constexpr int columns = 7;

struct Columns {
    std::vector<PetscVector> owned;
    std::vector<Vec> handles;
    Columns(const Comm& comm, int size) {
        for (int j = 0; j < columns; ++j) {
            owned.push_back(filled(comm, size, j + 1));
            handles.push_back(owned.back().get());
        }
    }
};

TEST_P(ExactVectors, HaveTheSameProductsAndNorms) {
    expect_equal([&](const Comm& comm) {
        const PetscVector x = filled(comm, GetParam(), 0);
        Columns y(comm, GetParam());
        std::vector<double> results(columns + 2);
        check(VecMDot(x.get(), columns, y.handles.data(), results.data()), "VecMDot");
        check(VecDot(x.get(), y.handles[2], &results[columns]), "VecDot");
        check(VecNorm(x.get(), NORM_2, &results[columns + 1]), "VecNorm");
        EXPECT_EQ(results[columns], results[2]);
        return results;
    });
}

TEST_P(ExactVectors, HaveTheProductsOfTheirEntries) {
    const PetscVector x = exact_vector(comm_, GetParam());
    PetscVector y;
    check(VecDuplicate(x.get(), y.out()), "VecDuplicate");
    check(VecSet(x.get(), 3.0), "VecSet");
    check(VecSet(y.get(), -2.0), "VecSet");
    double product = 0.0;
    double norm = 0.0;
    check(VecDot(x.get(), y.get(), &product), "VecDot");
    check(VecNorm(y.get(), NORM_2, &norm), "VecNorm");
    EXPECT_EQ(product, -6.0 * GetParam());
    EXPECT_EQ(norm, std::sqrt(4.0 * GetParam()));
}

TEST_P(ExactVectors, AreCombinedInTheSameWay) {
    const std::vector<double> weights = {0.3, -1.7, 1e-3, 2.5, 1.0, -0.1, 40.0};
    std::vector<double> expected;
    for (int i = 0; i < GetParam(); ++i) {
        double sum = entry(0, i);
        for (int j = 0; j < columns; ++j) sum += weights[static_cast<std::size_t>(j)] * entry(j + 1, i);
        expected.push_back(sum);
    }
    const PetscVector y = filled(comm_, GetParam(), 0);
    Columns x(comm_, GetParam());
    check(VecMAXPY(y.get(), columns, weights.data(), x.handles.data()), "VecMAXPY");
    EXPECT_EQ(gathered(comm_, y.get()), expected);
}

TEST_P(ExactVectors, AreAddedInTheSameWay) {
    const Columns x(comm_, GetParam());
    check(VecAXPY(x.handles[0], 0.7, x.handles[1]), "VecAXPY");
    check(VecAYPX(x.handles[1], 0.7, x.handles[2]), "VecAYPX");
    check(VecAXPBY(x.handles[2], 0.7, -0.4, x.handles[3]), "VecAXPBY");
    check(VecWAXPY(x.handles[5], 0.7, x.handles[3], x.handles[4]), "VecWAXPY");
    check(VecAXPBYPCZ(x.handles[6], 0.7, -0.4, 1.5, x.handles[3], x.handles[4]), "VecAXPBYPCZ");
    const auto close = [&](int column, int row, double expected) {
        const double scale = std::abs(entry(1, row)) + std::abs(entry(2, row)) + std::abs(entry(3, row)) +
                             std::abs(entry(4, row)) + std::abs(entry(5, row)) + std::abs(entry(7, row));
        EXPECT_NEAR(
            gathered(comm_, x.handles[static_cast<std::size_t>(column)])[static_cast<std::size_t>(row)],
            expected, 1e-14 * scale);
    };
    const int row = GetParam() - 1;
    close(0, row, entry(1, row) + 0.7 * entry(2, row));
    close(1, row, 0.7 * entry(2, row) + entry(3, row));
    close(2, row, 0.7 * entry(4, row) - 0.4 * entry(3, row));
    close(5, row, 0.7 * entry(4, row) + entry(5, row));
    close(6, row, 0.7 * entry(4, row) - 0.4 * entry(5, row) + 1.5 * entry(7, row));
}

TEST_P(ExactVectors, AreRandomByTheirGlobalPlace) {
    const auto two_draws = [&](const Comm& comm) {
        const PetscVector x = exact_vector(comm, GetParam());
        PetscRandom random = nullptr;
        check(PetscRandomCreate(comm.raw(), &random), "PetscRandomCreate");
        check(VecSetRandom(x.get(), random), "VecSetRandom");
        std::vector<double> first = gathered(comm, x.get());
        check(VecSetRandom(x.get(), random), "VecSetRandom");
        check(PetscRandomDestroy(&random), "PetscRandomDestroy");
        const std::vector<double> second = gathered(comm, x.get());
        EXPECT_NE(first, second);
        first.insert(first.end(), second.begin(), second.end());
        return first;
    };
    expect_equal(two_draws);
}

/// Column j of the basis after V(:, 1 .. 2) = V(:, 0 .. 3) Q(:, 1 .. 2), all columns joined.
std::vector<double> combined_basis(const Comm& comm, int size) {
    const PetscVector like = exact_vector(comm, size);
    const BasisVectors small = exact_basis(comm, like, 1);
    BasisVectors basis;
    check(BVResize(small.get(), 4, PETSC_FALSE), "BVResize");
    check(BVDuplicate(small.get(), basis.out()), "BVDuplicate");
    for (int j = 0; j < 4; ++j)
        check(BVInsertVec(basis.get(), j, filled(comm, size, j).get()), "BVInsertVec");
    PetscMatrix q;
    check(MatCreateSeqDense(PETSC_COMM_SELF, 4, 4, nullptr, q.out()), "MatCreateSeqDense");
    for (int r = 0; r < 4; ++r) {
        for (int c = 0; c < 4; ++c)
            check(MatSetValue(q.get(), r, c, 0.3 * r - 0.7 * c + 0.1, INSERT_VALUES), "MatSetValue");
    }
    check(MatAssemblyBegin(q.get(), MAT_FINAL_ASSEMBLY), "MatAssemblyBegin");
    check(MatAssemblyEnd(q.get(), MAT_FINAL_ASSEMBLY), "MatAssemblyEnd");
    check(BVMultInPlace(basis.get(), q.get(), 1, 3), "BVMultInPlace");
    std::vector<double> all;
    for (int j = 0; j < 4; ++j) {
        Vec column = nullptr;
        check(BVGetColumn(basis.get(), j, &column), "BVGetColumn");
        const std::vector<double> values = gathered(comm, column);
        all.insert(all.end(), values.begin(), values.end());
        check(BVRestoreColumn(basis.get(), j, &column), "BVRestoreColumn");
    }
    return all;
}

TEST_P(ExactVectors, OfABasisAreCombinedInPlace) {
    const int size = GetParam();
    std::vector<double> expected;
    for (int j = 0; j < 4; ++j) {
        for (int i = 0; i < size; ++i) {
            double sum = 0.0;
            for (int r = 0; r < 4; ++r) sum += (0.3 * r - 0.7 * j + 0.1) * entry(r, i);
            expected.push_back(j == 1 || j == 2 ? sum : entry(j, i));
        }
    }
    EXPECT_EQ(combined_basis(comm_, size), expected);
}

// 5: one rank owns everything; 70: uneven tiles and a short one; 1024: whole tiles.
INSTANTIATE_TEST_SUITE_P(Sizes, ExactVectors, testing::Values(5, 70, 301, 1024));

TEST(ExactVectorsOfPetsc, RefuseSumsThatPetscWouldFormItself) {
    const Comm comm(MPI_COMM_WORLD);
    const PetscVector x = filled(comm, 100, 0);
    check(PetscPushErrorHandler(PetscIgnoreErrorHandler, nullptr), "PetscPushErrorHandler");
    double product = 0.0;
    EXPECT_NE(VecDotBegin(x.get(), x.get(), &product), 0);
    EXPECT_NE(VecNorm(x.get(), NORM_1, &product), 0);
    check(PetscPopErrorHandler(), "PetscPopErrorHandler");
}

TEST(ExactVectorsOfPetsc, DoNotHideWhatIsNotFinite) {
    const Comm comm(MPI_COMM_WORLD);
    const PetscVector x = filled(comm, 100, 0);
    check(VecSet(x.get(), std::numeric_limits<double>::infinity()), "VecSet");
    check(PetscPushErrorHandler(PetscIgnoreErrorHandler, nullptr), "PetscPushErrorHandler");
    double product = 0.0;
    EXPECT_NE(VecDot(x.get(), x.get(), &product), 0);
    check(PetscPopErrorHandler(), "PetscPopErrorHandler");
}

}  // namespace
}  // namespace coseg
