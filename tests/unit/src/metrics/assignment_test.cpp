#include "src/metrics/assignment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "src/base/seeded_random.hpp"

namespace coseg {
namespace {

double sum_of(const Eigen::MatrixXd& gain, const std::vector<int>& column_of) {
    double sum = 0.0;
    for (int row = 0; row < gain.rows(); ++row) sum += column_of[row] < 0 ? 0.0 : gain(row, column_of[row]);
    return sum;
}

/// The best sum over all assignments of min(R, C) pairs, by trying every permutation of the longer side.
double best_sum_by_trial(const Eigen::MatrixXd& gain) {
    const Eigen::MatrixXd wide = gain.rows() <= gain.cols() ? gain : Eigen::MatrixXd(gain.transpose());
    std::vector<int> order(wide.cols());
    std::iota(order.begin(), order.end(), 0);
    double best = -std::numeric_limits<double>::infinity();
    do {
        double sum = 0.0;
        for (int row = 0; row < wide.rows(); ++row) sum += wide(row, order[row]);
        best = std::max(best, sum);
    } while (std::next_permutation(order.begin(), order.end()));
    return best;
}

void expect_one_to_one(const Eigen::MatrixXd& gain, const std::vector<int>& column_of) {
    ASSERT_EQ(static_cast<Eigen::Index>(column_of.size()), gain.rows());
    std::vector<int> taken(gain.cols(), 0);
    Eigen::Index pairs = 0;
    for (const int column : column_of) {
        if (column == -1) continue;
        ASSERT_GE(column, 0);
        ASSERT_LT(column, gain.cols());
        EXPECT_EQ(++taken[column], 1);
        ++pairs;
    }
    EXPECT_EQ(pairs, std::min(gain.rows(), gain.cols()));
}

Eigen::MatrixXd random_gain(int rows, int columns, std::uint64_t seed) {
    Eigen::MatrixXd gain(rows, columns);
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const std::uint64_t hash =
                hash_words({seed, static_cast<std::uint64_t>(row), static_cast<std::uint64_t>(column)});
            gain(row, column) = 2.0 * uniform_of(hash) - 1.0;
        }
    }
    return gain;
}

TEST(Assignment, IsTheBestOfAllOnRandomGainsOfEveryShape) {
    for (int rows = 1; rows <= 6; ++rows) {
        for (int columns = 1; columns <= 6; ++columns) {
            for (std::uint64_t seed = 0; seed < 20; ++seed) {
                const Eigen::MatrixXd gain = random_gain(rows, columns, seed);
                const std::vector<int> column_of = best_assignment(gain);
                expect_one_to_one(gain, column_of);
                EXPECT_NEAR(sum_of(gain, column_of), best_sum_by_trial(gain), 1e-12)
                    << rows << " x " << columns << " seed " << seed;
            }
        }
    }
}

TEST(Assignment, IsTheBestOfAllWhereManyAreEquallyGood) {
    for (int size = 1; size <= 6; ++size) {
        for (std::uint64_t seed = 0; seed < 20; ++seed) {
            const Eigen::MatrixXd gain = (2.0 * random_gain(size, 6, seed)).array().round().matrix();
            const std::vector<int> column_of = best_assignment(gain);
            expect_one_to_one(gain, column_of);
            EXPECT_DOUBLE_EQ(sum_of(gain, column_of), best_sum_by_trial(gain));
        }
    }
}

TEST(Assignment, FindsAHiddenPermutationAmongMany) {
    constexpr int size = 60;
    Eigen::MatrixXd gain = 0.4 * random_gain(size, size, 7);
    for (int row = 0; row < size; ++row) gain(row, (row * 7 + 3) % size) += 1.0;
    const std::vector<int> column_of = best_assignment(gain);
    for (int row = 0; row < size; ++row) EXPECT_EQ(column_of[row], (row * 7 + 3) % size);
}

TEST(Assignment, GivesUpTheGreedyPairForTheBetterWhole) {
    Eigen::MatrixXd gain(2, 2);
    gain << 10.0, 9.0, 9.0, 1.0;
    EXPECT_EQ(best_assignment(gain), (std::vector<int>{1, 0}));
}

TEST(Assignment, LeavesRowsOverWhereColumnsRunOut) {
    Eigen::MatrixXd gain(3, 1);
    gain << 1.0, 3.0, 2.0;
    EXPECT_EQ(best_assignment(gain), (std::vector<int>{-1, 0, -1}));
}

TEST(Assignment, OfNothingIsNothing) {
    EXPECT_TRUE(best_assignment(Eigen::MatrixXd(0, 0)).empty());
    EXPECT_EQ(best_assignment(Eigen::MatrixXd(2, 0)), (std::vector<int>{-1, -1}));
}

}  // namespace
}  // namespace coseg
