#include "solvers/spectral/sliced_rows.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "src/base/seeded_random.hpp"

namespace coseg {
namespace {

/// Rows of very different lengths, some of them empty, in a matrix of `columns` columns.
SparseRows uneven_rows(int rows, int columns) {
    SeededStream random(hash_words({17, static_cast<std::uint64_t>(rows)}));
    SparseRows matrix;
    matrix.size = columns;
    matrix.rows = {0, rows};
    for (int r = 0; r < rows; ++r) {
        const double share = r % 5 == 0 ? 0.0 : random.uniform();
        for (int c = 0; c < columns; ++c) {
            if (random.uniform() >= share) continue;
            matrix.columns.push_back(c);
            matrix.values.push_back(random.uniform() - 0.5);
        }
        matrix.offsets.push_back(static_cast<std::int64_t>(matrix.columns.size()));
    }
    return matrix;
}

std::vector<double> plain_product(const SparseRows& matrix, const std::vector<double>& x) {
    std::vector<double> y;
    for (std::size_t r = 0; r + 1 < matrix.offsets.size(); ++r) {
        double sum = 0.0;
        for (auto k = static_cast<std::size_t>(matrix.offsets[r]);
             k < static_cast<std::size_t>(matrix.offsets[r + 1]); ++k)
            sum += matrix.values[k] * x[static_cast<std::size_t>(matrix.columns[k])];
        y.push_back(sum);
    }
    return y;
}

class SlicedRowsOf : public testing::TestWithParam<int> {};

TEST_P(SlicedRowsOf, HaveTheProductOfPlainRowsToTheLastBit) {
    const int columns = 61;
    const SparseRows matrix = uneven_rows(GetParam(), columns);
    std::vector<double> x;
    for (std::uint64_t i = 0; i < columns; ++i) x.push_back(uniform_of(hash_words({5, i})) - 0.5);
    std::vector<double> y(static_cast<std::size_t>(GetParam()), std::numeric_limits<double>::quiet_NaN());
    const SlicedRows sliced(matrix);
    sliced.multiply(x.data(), y.data());
    EXPECT_EQ(y, plain_product(matrix, x));
}

TEST_P(SlicedRowsOf, InSinglePrecisionHaveTheProductOfRoundedEntries) {
    const int columns = 61;
    SparseRows matrix = uneven_rows(GetParam(), columns);
    std::vector<double> x;
    for (std::uint64_t i = 0; i < columns; ++i) x.push_back(uniform_of(hash_words({6, i})) - 0.5);
    std::vector<double> y(static_cast<std::size_t>(GetParam()), std::numeric_limits<double>::quiet_NaN());
    SlicedRows(matrix, EntryPrecision::single).multiply(x.data(), y.data());
    for (double& value : matrix.values) value = static_cast<double>(static_cast<float>(value));
    EXPECT_EQ(y, plain_product(matrix, x));
}

// Less than a slice, whole slices, less and more than a window.
INSTANTIATE_TEST_SUITE_P(Sizes, SlicedRowsOf, testing::Values(1, 7, 8, 16, 29, 256, 257, 600));

TEST(SlicedRows, WithoutRowsTouchNothing) {
    SparseRows empty;
    empty.size = 3;
    const SlicedRows none(empty);
    double untouched = 4.0;
    none.multiply(nullptr, &untouched);
    EXPECT_EQ(untouched, 4.0);
}

}  // namespace
}  // namespace coseg
