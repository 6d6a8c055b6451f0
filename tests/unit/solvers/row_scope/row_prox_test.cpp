#include "solvers/row_scope/row_prox.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "solvers/subspace/group_shrinkage.hpp"
#include "src/base/seeded_random.hpp"

namespace coseg {
namespace {

struct Row {
    std::size_t features;
    double step, alpha, beta, lambda;
    std::vector<double> v;
};

double objective(const Row& row, const std::vector<double>& w) {
    double value = 0.0;
    std::vector<double> sums(row.features, 0.0);
    for (std::size_t at = 0; at < w.size(); at += row.features) {
        double squares = 0.0;
        for (std::size_t h = 0; h < row.features; ++h) {
            value += std::pow(w[at + h] - row.v[at + h], 2) / 2.0 + row.step * row.beta * w[at + h];
            squares += w[at + h] * w[at + h];
            sums[h] += w[at + h];
        }
        value += row.step * row.alpha * std::sqrt(squares);
    }
    for (const double sum : sums) value += row.step * row.lambda * sum * sum;
    return value;
}

Row random_row(SeededStream& random, std::size_t features, std::size_t pairs, double lambda) {
    Row row{features, random.uniform(0.05, 2.0), random.uniform(0.0, 0.3), random.uniform(0.0, 0.3), lambda,
            {}};
    for (std::size_t at = 0; at < features * pairs; ++at) row.v.push_back(random.normal() + 0.5);
    return row;
}

TEST(RowProx, NoMoveLowersTheObjective) {
    SeededStream random(51);
    for (int repeat = 0; repeat < 60; ++repeat) {
        const auto features = static_cast<std::size_t>(1 + repeat % 6);
        const auto pairs = static_cast<std::size_t>(1 + repeat % 9);
        Row row = random_row(random, features, pairs, std::pow(10.0, random.uniform(-3.0, 5.0)));
        if (repeat % 4 == 0) row.alpha = 0.0;
        std::vector<double> w = row.v;
        std::vector<double> price(features, 0.0);
        RowProx(static_cast<int>(features), row.alpha, row.beta, row.lambda).shrink(w, row.step, price);
        const double best = objective(row, w);
        for (int trial = 0; trial < 300; ++trial) {
            std::vector<double> moved = w;
            const double size = std::pow(10.0, random.uniform(-7.0, 0.0));
            for (double& value : moved) {
                if (random.uniform() < 0.5) value = std::max(0.0, value + size * random.normal());
            }
            ASSERT_GE(objective(row, moved), best - 1e-13 * (1.0 + best)) << repeat;
        }
    }
}

TEST(RowProx, ThePriceIsTwiceLambdaTheRowSum) {
    SeededStream random(52);
    for (int repeat = 0; repeat < 40; ++repeat) {
        const Row row = random_row(random, 3, 12, std::pow(10.0, random.uniform(-2.0, 4.0)));
        std::vector<double> w = row.v;
        std::vector<double> price(3, random.uniform(0.0, 10.0));  // any first guess gives the same answer
        RowProx(3, row.alpha, row.beta, row.lambda).shrink(w, row.step, price);
        for (std::size_t h = 0; h < 3; ++h) {
            double sum = 0.0;
            for (std::size_t at = h; at < w.size(); at += 3) sum += w[at];
            EXPECT_NEAR(price[h], 2.0 * row.lambda * sum,
                        1e-12 * (1.0 + price[h]) * (1.0 + row.lambda * row.step));
        }
    }
}

TEST(RowProx, WithoutLambdaEachPairShrinksAlone) {
    SeededStream random(53);
    const Row row = random_row(random, 4, 5, 0.0);
    std::vector<double> w = row.v;
    std::vector<double> alone = row.v;
    std::vector<double> price(4, 1.0);
    RowProx(4, row.alpha, row.beta, 0.0).shrink(w, row.step, price);
    for (std::size_t at = 0; at < alone.size(); at += 4) {
        shrink_group(std::span(alone).subspan(at, 4), row.step, row.alpha, row.beta);
    }
    EXPECT_EQ(w, alone);
    EXPECT_EQ(price, std::vector<double>(4, 0.0));
}

}  // namespace
}  // namespace coseg
