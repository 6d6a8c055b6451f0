#include "solvers/numeric/pair_score_kernel.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "src/base/seeded_random.hpp"

namespace coseg {
namespace {

constexpr int groups = 3;
constexpr int columns = groups * group_columns;
constexpr int depth = 37;

struct Product {
    std::vector<float> rows, duals, prices, errors;
    std::vector<float> scores = std::vector<float>(panel_rows * columns, -1.0F);
    std::vector<float> squares = std::vector<float>(panel_rows * columns, 0.25F);

    [[nodiscard]] float row(int r, int k) const { return rows[static_cast<std::size_t>(k * panel_rows + r)]; }
    [[nodiscard]] float& dual(int c, int k) {
        return duals[static_cast<std::size_t>((c / group_columns * depth + k) * group_columns +
                                              c % group_columns)];
    }
    void compute() {
        score_pairs({rows.data(), prices.data()}, {duals.data(), errors.data(), groups}, depth,
                    {scores.data(), squares.data()});
    }
};

Product random_product() {
    SeededStream random(5);
    Product product;
    const auto fill = [&](std::vector<float>& values, int count, double low, double high) {
        for (int i = 0; i < count; ++i) values.push_back(static_cast<float>(random.uniform(low, high)));
    };
    fill(product.rows, panel_rows * depth, 0.0, 1.0);
    fill(product.duals, columns * depth, -1.0, 1.0);
    fill(product.prices, panel_rows, -1.0, 1.0);
    fill(product.errors, columns, 0.0, 0.1);
    return product;
}

TEST(ScorePanel, IsTheProductAndTheSquaresOfItsExcess) {
    Product product = random_product();
    product.compute();
    for (int c = 0; c < columns; ++c) {
        for (int r = 0; r < panel_rows; ++r) {
            double score = 0.0, size = 0.0;
            for (int k = 0; k < depth; ++k) {
                const double term = double{product.row(r, k)} * double{product.dual(c, k)};
                score += term;
                size += std::abs(term);
            }
            const auto at = static_cast<std::size_t>(c * panel_rows + r);
            EXPECT_NEAR(product.scores[at], score, (depth + 2) * 6e-8 * size);
            const double excess =
                std::max(double{product.scores[at]} + double{product.errors[static_cast<std::size_t>(c)]} -
                             double{product.prices[static_cast<std::size_t>(r)]},
                         0.0);
            EXPECT_NEAR(product.squares[at], 0.25 + excess * excess, 1e-6 * (1.0 + excess * excess));
        }
    }
}

TEST(ScorePanel, GivesTheUsedRowsTheSameBits) {
    Product whole = random_product();
    whole.compute();
    for (int used = 1; used <= panel_rows; ++used) {
        Product part = random_product();
        score_pairs({part.rows.data(), part.prices.data(), used},
                    {part.duals.data(), part.errors.data(), groups}, depth,
                    {part.scores.data(), part.squares.data()});
        for (int place = 0; place < panel_rows * columns; ++place) {
            const auto at = static_cast<std::size_t>(place);
            if (place % panel_rows < used) {
                ASSERT_EQ(part.scores[at], whole.scores[at]) << used << " " << place;
                ASSERT_EQ(part.squares[at], whole.squares[at]) << used << " " << place;
            }
        }
    }
}

TEST(ScorePanel, BitsDependOnARowAndAColumnAlone) {
    Product product = random_product();
    for (int k = 0; k < depth; ++k) {
        for (int r = 0; r < panel_rows; ++r)
            product.rows[static_cast<std::size_t>(k * panel_rows + r)] = product.row(0, k);
        for (int c = 0; c < columns; ++c) product.dual(c, k) = product.dual(0, k);
    }
    product.compute();
    for (const float score : product.scores) EXPECT_EQ(score, product.scores.front());
}

TEST(FindAbove, MarksTheRowsOfEachColumn) {
    std::vector<float> values(panel_rows * 2, 1.0F);
    values[0] = 3.0F;
    values[47] = 2.5F;
    values[panel_rows + 20] = 2.0F;  // not above
    std::uint64_t above[2];
    find_above(values.data(), 2, 2.0F, above);
    EXPECT_EQ(above[0], 1U | std::uint64_t{1} << 47);
    EXPECT_EQ(above[1], 0U);

    std::vector<float> row_bounds(panel_rows, 10.0F);
    row_bounds[47] = 2.5F;
    const float column_bounds[2] = {2.75F, 0.5F};
    find_above(values.data(), 2, 0.75F, row_bounds.data(), column_bounds, above);
    EXPECT_EQ(above[0], 1U | std::uint64_t{1} << 47);  // by its column, by its row
    EXPECT_EQ(above[1], (std::uint64_t{1} << panel_rows) - 1);
}

}  // namespace
}  // namespace coseg
