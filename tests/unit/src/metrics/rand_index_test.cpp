#include "src/metrics/rand_index.hpp"

#include <gtest/gtest.h>

#include "src/base/seeded_random.hpp"

namespace coseg {
namespace {

struct Sample {
    std::vector<int> truth;
    std::vector<int> labels;
    std::vector<double> weight;
};

Sample random_sample(int size, std::uint64_t seed) {
    Sample sample;
    for (std::uint64_t i = 0; i < static_cast<std::uint64_t>(size); ++i) {
        sample.truth.push_back(static_cast<int>(4.0 * uniform_of(hash_words({seed, i, 1}))) - 1);
        sample.labels.push_back(static_cast<int>(5.0 * uniform_of(hash_words({seed, i, 2}))));
        sample.weight.push_back(uniform_of(hash_words({seed, i, 3})));
    }
    return sample;
}

bool treated_alike(const Sample& sample, std::size_t a, std::size_t b) {
    return (sample.truth[a] == sample.truth[b]) == (sample.labels[a] == sample.labels[b]);
}

TEST(RandIndex, IsTheShareOfPairsOfPointsTreatedAlike) {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        const Sample sample = random_sample(40, seed);
        double alike = 0.0;
        double all = 0.0;
        for (std::size_t a = 0; a < sample.truth.size(); ++a) {
            for (std::size_t b = 0; b < sample.truth.size(); ++b) {
                if (sample.truth[a] < 0 || sample.truth[b] < 0) continue;
                const double pair = sample.weight[a] * sample.weight[b];
                all += pair;
                alike += treated_alike(sample, a, b) ? pair : 0.0;
            }
        }
        EXPECT_NEAR(rand_index(sample.truth, sample.labels, sample.weight), alike / all, 1e-12);
    }
}

TEST(RandIndex, OfFacesIsTheShareOfPairsOfDifferentFacesTreatedAlike) {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        const Sample sample = random_sample(40, seed);
        int alike = 0;
        int all = 0;
        for (std::size_t a = 0; a < sample.truth.size(); ++a) {
            for (std::size_t b = a + 1; b < sample.truth.size(); ++b) {
                if (sample.truth[a] < 0 || sample.truth[b] < 0) continue;
                ++all;
                alike += treated_alike(sample, a, b) ? 1 : 0;
            }
        }
        EXPECT_NEAR(rand_index(sample.truth, sample.labels), static_cast<double>(alike) / all, 1e-12);
    }
}

TEST(RandIndex, IsOneForTheSameSegmentationUnderOtherNames) {
    EXPECT_DOUBLE_EQ(rand_index({0, 0, 1, 2}, {7, 7, 5, 6}, {0.5, 1.0, 2.0, 0.1}), 1.0);
    EXPECT_DOUBLE_EQ(rand_index({0, 0, 1, 2}, {7, 7, 5, 6}), 1.0);
}

TEST(RandIndex, OfTwoHalvesAgainstOneWholeIsOneHalf) {
    EXPECT_DOUBLE_EQ(rand_index({0, 1}, {3, 3}, {1.0, 1.0}), 0.5);
}

TEST(RandIndex, OfTwoFacesWronglyJoinedIsZero) { EXPECT_DOUBLE_EQ(rand_index({0, 1}, {3, 3}), 0.0); }

TEST(RandIndex, IsZeroWhereNothingHasATruth) {
    EXPECT_DOUBLE_EQ(rand_index({-1, -1}, {0, 1}, {1.0, 1.0}), 0.0);
    EXPECT_DOUBLE_EQ(rand_index({-1, -1}, {0, 1}), 0.0);
}

}  // namespace
}  // namespace coseg
