#include "solvers/partition_choice.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace coseg {
namespace {

TEST(PartitionChoice, ConcavityIsWeightedByLengthAndIgnoresTheInside) {
    const std::vector<PatchRelation> neighbors = {{0, 1, 3.0, 0.9}, {1, 2, 1.0, 0.1}, {2, 3, 5.0, 0.7}};
    EXPECT_DOUBLE_EQ(boundary_concavity(neighbors, {0, 1, 2, 2}), (3.0 * 0.9 + 0.1) / 4.0);
    EXPECT_EQ(boundary_concavity(neighbors, {0, 0, 0, 0}), 0.0);
}

TEST(PartitionChoice, SharesAreMeansOverMeshesOfAnySize) {
    const std::vector<double> shares =
        mean_area_shares({0, 1, 0, 1, 1}, 2, {1.0, 3.0, 50.0, 25.0, 25.0}, {0, 0, 1, 1, 1});
    EXPECT_DOUBLE_EQ(shares[0], 0.5 * (0.25 + 0.5));
    EXPECT_DOUBLE_EQ(shares[1], 0.5 * (0.75 + 0.5));
}

TEST(PartitionChoice, EntropyOfEvenSharesIsTheLogarithm) {
    EXPECT_NEAR(entropy(std::vector<double>{0.25, 0.25, 0.25, 0.25}), std::log(4.0), 1e-15);
    EXPECT_EQ(entropy(std::vector<double>{1.0, 0.0}), 0.0);
}

TEST(PartitionChoice, ScoresAreStandardisedTermByTerm) {
    const std::vector<PartitionTerms> terms = {{1.0, 0.2, 5.0}, {3.0, 0.2, 5.0}};
    const std::vector<double> scores = partition_scores(terms, {2.0, 10.0, 10.0});
    EXPECT_NEAR(scores[0], -2.0,
                1e-14);  // one deviation below the mean, times 2; what does not vary has no say
    EXPECT_NEAR(scores[1], 2.0, 1e-14);
}

TEST(PartitionChoice, ScoresDoNotDependOnTheUnitOfATerm) {
    const std::vector<PartitionTerms> terms = {{1.0, 0.2, 1.5}, {3.0, 0.9, 1.0}, {2.5, 0.4, 1.2}};
    std::vector<PartitionTerms> scaled = terms;
    for (PartitionTerms& t : scaled) {
        t.association = 1e3 * t.association + 7.0;
        t.concavity *= 1e-6;
    }
    const std::vector<double> a = partition_scores(terms, {});
    const std::vector<double> b = partition_scores(scaled, {});
    for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(a[k], b[k], 1e-9);
    EXPECT_NEAR(a[0] + a[1] + a[2], 0.0, 1e-12);
}

TEST(PartitionChoice, RoundingIsNoDifference) {
    const std::vector<PartitionTerms> terms = {{2.0, 0.0, 0.0}, {2.0 + 4e-16, 0.0, 0.0}, {2.0, 0.0, 0.0}};
    EXPECT_EQ(partition_scores(terms, {}), std::vector<double>(3, 0.0));
}

TEST(PartitionChoice, PartsAreNumberedByShareThenByLowestPatch) {
    const std::vector<int> labels = {3, 0, 0, 1, 3};
    EXPECT_EQ(
        canonical_labels(labels, 4, {1.0, 1.0, 1.0, 2.0, 5.0}, {0, 0, 0, 0, 0}),
        (std::vector<int>{0, 1, 1, 2, 0}));  // shares .6, .2, .2: the tie goes to patch 1 before patch 3
    const std::vector<int> renamed = {1, 2, 2, 0, 1};
    EXPECT_EQ(canonical_labels(renamed, 3, {1.0, 1.0, 1.0, 2.0, 5.0}, {0, 0, 0, 0, 0}),
              (std::vector<int>{0, 1, 1, 2, 0}));
}

TEST(PartitionChoice, EvennessIsZeroForEqualProportionsAndLeastForPartsThatAreWholeMeshes) {
    Eigen::MatrixXd even(2, 3);
    even << 0.3, 0.3, 0.3, 0.7, 0.7, 0.7;
    EXPECT_NEAR(evenness(even), 0.0, 1e-15);
    EXPECT_NEAR(evenness(Eigen::MatrixXd::Identity(4, 4)), -std::log(4.0), 1e-15);
}

TEST(PartitionChoice, PresenceCountsMeshesWithAQuarterOfThePartsMean) {
    Eigen::MatrixXd shares(3, 4);
    shares << 0.5, 0.4, 0.02, 0.0,  //
        0.5, 0.6, 0.98, 1.0,        //
        0.0, 0.0, 0.0, 0.0;
    EXPECT_DOUBLE_EQ(presence(shares), 6.0 / 12.0);
}

TEST(PartitionChoice, AgreementIsTheMeanWithTheOthers) {
    const std::vector<std::vector<int>> partitions = {{0, 0, 1, 1}, {1, 1, 0, 0}, {0, 1, 0, 1}};
    const std::vector<double> mean = agreement(partitions, {1.0, 1.0, 1.0, 1.0});
    EXPECT_NEAR(mean[0], 0.5, 1e-15);
    EXPECT_NEAR(mean[1], 0.5, 1e-15);
    EXPECT_NEAR(mean[2], 0.0, 1e-15);
    EXPECT_EQ(agreement({{0, 1}}, {1.0, 1.0}), std::vector<double>{1.0});
}

}  // namespace
}  // namespace coseg
