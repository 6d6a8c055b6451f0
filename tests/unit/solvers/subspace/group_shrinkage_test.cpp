#include "solvers/subspace/group_shrinkage.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "src/base/seeded_random.hpp"

namespace coseg {
namespace {

struct Penalties {
    double step, alpha, beta, lambda;
};

/// The function that the prox minimises; `features` values a pair, all pairs in one group.
double prox_objective(const std::vector<double>& w, const std::vector<double>& v, std::size_t features,
                      const Penalties& p) {
    double distance = 0.0, entries = 0.0, norms = 0.0;
    for (std::size_t pair = 0; pair < w.size() / features; ++pair) {
        double squares = 0.0;
        for (std::size_t h = 0; h < features; ++h) {
            const double value = w[pair * features + h];
            distance += std::pow(value - v[pair * features + h], 2) / 2.0;
            entries += value;
            squares += value * value;
        }
        norms += std::sqrt(squares);
    }
    return distance + p.step * (p.lambda * norms * norms + p.alpha * norms + p.beta * entries);
}

/// No move of a few random directions and sizes, kept nonnegative, lowers the objective.
void expect_minimum(const std::vector<double>& w, const std::vector<double>& v, std::size_t features,
                    const Penalties& p, SeededStream& random) {
    const double best = prox_objective(w, v, features, p);
    for (int trial = 0; trial < 300; ++trial) {
        std::vector<double> moved = w;
        const double size = std::pow(10.0, random.uniform(-6.0, 0.0));
        for (double& value : moved) {
            if (random.uniform() < 0.5) value = std::max(0.0, value + size * random.normal());
        }
        EXPECT_GE(prox_objective(moved, v, features, p), best - 1e-14 * (1.0 + std::abs(best)));
    }
}

std::vector<double> random_values(SeededStream& random, std::size_t count) {
    std::vector<double> values(count);
    for (double& value : values) value = random.normal() + 0.5;
    return values;
}

TEST(GroupShrinkage, NoMoveLowersTheObjective) {
    SeededStream random(11);
    for (int repeat = 0; repeat < 30; ++repeat) {
        const std::size_t features = 1 + static_cast<std::size_t>(repeat % 6);
        const Penalties p{random.uniform(0.01, 3.0), random.uniform(0.0, 0.5), random.uniform(0.0, 0.5), 0.0};
        const std::vector<double> v = random_values(random, features);
        std::vector<double> w = v;
        const double norm = shrink_group(w, p.step, p.alpha, p.beta);
        EXPECT_NEAR(norm, std::sqrt(std::inner_product(w.begin(), w.end(), w.begin(), 0.0)), 1e-14);
        expect_minimum(w, v, features, p, random);
    }
}

TEST(GroupShrinkage, KnownValues) {
    std::vector<double> w{4.0, -1.0, 5.0};
    EXPECT_DOUBLE_EQ(shrink_group(w, 1.0, 2.5, 1.0), 2.5);  // (3, 0, 4), norm 5, halved
    EXPECT_EQ(w, (std::vector<double>{1.5, 0.0, 2.0}));
    std::vector<double> small{0.3, 0.4};
    EXPECT_EQ(shrink_group(small, 1.0, 0.5, 0.0), 0.0);
    EXPECT_EQ(small, (std::vector<double>{0.0, 0.0}));
}

TEST(ExclusiveShrinkage, NoMoveLowersTheObjective) {
    SeededStream random(12);
    ExclusiveShrinkScratch scratch;
    for (int repeat = 0; repeat < 60; ++repeat) {
        const std::size_t features = 1 + static_cast<std::size_t>(repeat % 4);
        const std::size_t pairs = 1 + static_cast<std::size_t>(repeat % 7);
        const double lambda = repeat % 3 == 0 ? 0.0 : std::pow(10.0, random.uniform(-2.0, 3.0));
        const Penalties p{random.uniform(0.01, 2.0), random.uniform(0.0, 0.5), random.uniform(0.0, 0.5),
                          lambda};
        std::vector<double> v = random_values(random, features * pairs);
        if (repeat % 5 == 0 && pairs > 1)
            std::copy_n(v.begin(), features, v.begin() + static_cast<std::ptrdiff_t>(features));
        std::vector<double> w = v;
        exclusive_shrink(w, static_cast<int>(features), p.step, {p.alpha, p.beta, p.lambda}, scratch);
        expect_minimum(w, v, features, p, random);
    }
}

/// H = 1 against bisection on s: w_i = (v_i - t beta - t alpha - 2 t lambda s)_+ with s = sum w.
TEST(ExclusiveShrinkage, AgreesWithBisectionForOneFeature) {
    SeededStream random(13);
    ExclusiveShrinkScratch scratch;
    for (int repeat = 0; repeat < 50; ++repeat) {
        const Penalties p{random.uniform(0.1, 2.0), 0.1, 0.05, std::pow(10.0, random.uniform(-2.0, 3.0))};
        const std::vector<double> v = random_values(random, 9);
        const auto sum_at = [&](double s) {
            double sum = 0.0;
            for (const double value : v)
                sum += std::max(value - p.step * (p.alpha + p.beta + 2.0 * p.lambda * s), 0.0);
            return sum;
        };
        double low = 0.0, high = 100.0;
        for (int k = 0; k < 200; ++k)
            (sum_at(0.5 * (low + high)) > 0.5 * (low + high) ? low : high) = 0.5 * (low + high);
        std::vector<double> w = v;
        EXPECT_NEAR(exclusive_shrink(w, 1, p.step, {p.alpha, p.beta, p.lambda}, scratch), low,
                    1e-13 * (1.0 + low));
    }
}

TEST(ExclusiveShrinkage, EmptyAndAllNegativeGroupsAreZero) {
    ExclusiveShrinkScratch scratch;
    std::vector<double> none;
    EXPECT_EQ(exclusive_shrink(none, 3, 1.0, {0.1, 0.1, 10.0}, scratch), 0.0);
    std::vector<double> negative{-1.0, -2.0, -3.0, -4.0};
    EXPECT_EQ(exclusive_shrink(negative, 2, 1.0, {}, scratch), 0.0);
    EXPECT_EQ(negative, std::vector<double>(4, 0.0));
}

}  // namespace
}  // namespace coseg
