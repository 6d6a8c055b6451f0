#include "solvers/choice/partition_terms.hpp"

#include <gtest/gtest.h>

namespace coseg {
namespace {

TEST(PartitionTerms, ConcavityIsWeightedByLengthAndIgnoresTheInside) {
    const std::vector<GlobalPatchNeighbors> neighbors = {
        {0, 1, 3.0, 0.9}, {1, 2, 1.0, 0.1}, {2, 3, 5.0, 0.7}};
    EXPECT_DOUBLE_EQ(boundary_concavity(neighbors, {0, 1, 2, 2}), (3.0 * 0.9 + 0.1) / 4.0);
    EXPECT_EQ(boundary_concavity(neighbors, {0, 0, 0, 0}), 0.0);
}

TEST(PartitionTerms, SizeSteadinessIsTheRelativeVarianceOfShares) {
    Eigen::MatrixXd shares(3, 2);
    shares << 0.2, 0.4,  //
        0.8, 0.6,        //
        0.0, 0.0;
    EXPECT_NEAR(size_steadiness(shares), -(0.01 / 0.3 + 0.01 / 0.7), 1e-15);
    Eigen::MatrixXd alone = Eigen::MatrixXd::Zero(1, 5);
    alone(0, 3) = 1.0;  // one mesh of five has it
    EXPECT_NEAR(size_steadiness(alone), -4.0 * 0.2, 1e-15);
}

TEST(PartitionTerms, TheScoreIsASumThatOtherPartitionsDoNotChange) {
    PartitionTerms terms;
    terms.explained = {{.pooled = 0.25, .per_mesh = 0.5}};
    terms.crease = -2.0;
    terms.overlap = 0.75;
    terms.concavity = 0.5;
    terms.size = -0.125;
    terms.links = 0.5;
    const std::vector<ChoiceDescriptor> descriptors = {
        {patch_columns(Eigen::MatrixXf()), {.pooled = 8.0, .per_mesh = 16.0}}};
    const ChoiceWeights weights{.crease = 3.0, .overlap = 20.0, .concavity = 4.0, .size = 40.0, .links = 6.0};
    EXPECT_DOUBLE_EQ(partition_score(terms, weights, descriptors), 2.0 + 8.0 - 6.0 + 15.0 + 2.0 - 5.0 + 3.0);
}

TEST(PartitionTerms, LinksInsideIsAShareByWeight) {
    const SparseRows links =
        rows_from_entries(3, {0, 3}, {{0, 1, 3.0}, {1, 0, 3.0}, {1, 2, 1.0}, {2, 1, 1.0}});
    EXPECT_DOUBLE_EQ(links_inside(links, {0, 0, 1}), 0.75);
    EXPECT_DOUBLE_EQ(links_inside(links, {0, 0, 0}), 1.0);
    EXPECT_EQ(links_inside(rows_from_entries(3, {0, 3}, {}), {0, 0, 1}), 0.0);
}

TEST(PartitionTerms, CreaseIsLengthAndFlatnessOfBoundariesAMesh) {
    const std::vector<GlobalPatchNeighbors> neighbors = {
        {0, 1, 3.0, 0.5}, {1, 2, 1.0, 1.0}, {2, 3, 5.0, 0.0}};
    EXPECT_DOUBLE_EQ(boundary_crease(neighbors, {0, 1, 2, 2}, 2), -3.0 * 0.25 / 2.0);
    EXPECT_DOUBLE_EQ(boundary_crease(neighbors, {0, 0, 0, 1}, 1), -5.0);
    EXPECT_EQ(boundary_crease(neighbors, {0, 0, 0, 0}, 1), 0.0);
}

TEST(PartitionTerms, OverlapAgreementIsTheShareOfTheOwnPartByArea) {
    const std::vector<GlobalPatchOverlap> overlaps = {{0, 2, 0.6}, {0, 3, 0.2}, {1, 3, 0.8}};
    // 0: .6 of .8 with its own part; 1: none; 2: all; 3: .2 of 1; 4 overlaps nothing
    EXPECT_NEAR(overlap_agreement(overlaps, {0, 1, 0, 2, 2}, {1.0, 2.0, 1.0, 2.0, 50.0}),
                (0.75 + 0.0 + 1.0 + 0.0) / 6.0, 1e-15);
    EXPECT_EQ(overlap_agreement({}, {0, 1}, {1.0, 1.0}), 1.0);
}

TEST(PartitionTerms, PartsThatAreAlikeInsideExplainAllAndPartsWithOneMeanNothing) {
    Eigen::MatrixXf values(2, 4);
    values << 1, 1, 0, 0, 0, 0, 1, 1;
    const PatchColumns histograms = patch_columns(values);
    const std::vector<int> one_mesh(4, 0);
    const std::vector<double> area = {1.0, 2.0, 3.0, 4.0};
    const BetweenPartVariance all = between_part_variance(histograms, {0, 0, 1, 1}, 2, area, one_mesh);
    EXPECT_NEAR(all.pooled, 1.0, 1e-15);
    EXPECT_NEAR(all.per_mesh, 1.0, 1e-15);
    const BetweenPartVariance nothing =
        between_part_variance(histograms, {0, 1, 0, 1}, 2, {1, 1, 1, 1}, one_mesh);
    EXPECT_NEAR(nothing.pooled, 0.0, 1e-15);
    EXPECT_NEAR(nothing.per_mesh, 0.0, 1e-15);
    const Eigen::MatrixXf alike = Eigen::MatrixXf::Ones(2, 4);
    EXPECT_EQ(between_part_variance(patch_columns(alike), {0, 1, 0, 1}, 2, area, one_mesh),
              BetweenPartVariance{});
}

TEST(PartitionTerms, InOneMeshTheExplainedSpreadIsThatOfTheAnalysisOfVariance) {
    Eigen::MatrixXf values(1, 5);
    values << 1, 2, 4, 7, 11;
    const std::vector<int> labels = {0, 0, 1, 1, 1};
    const double mean = 5.0;
    const double first = 1.5;
    const double second = 22.0 / 3.0;
    double spread = 0.0;
    for (Eigen::Index i = 0; i < 5; ++i) spread += (values(0, i) - mean) * (values(0, i) - mean);
    const double between = 2.0 * (first - mean) * (first - mean) + 3.0 * (second - mean) * (second - mean);
    const BetweenPartVariance explained = between_part_variance(
        patch_columns(values), labels, 2, std::vector<double>(5, 1.0), std::vector<int>(5, 0));
    EXPECT_NEAR(explained.pooled, between / spread, 1e-14);
    EXPECT_NEAR(explained.per_mesh, between / spread, 1e-14);
}

/// Two meshes of two patches: what tells the patches apart, and what the meshes.
BetweenPartVariance of_two_meshes(float first_a, float first_b, float second_a, float second_b,
                                  const std::vector<int>& labels) {
    Eigen::MatrixXf values(1, 4);
    values << first_a, first_b, second_a, second_b;
    return between_part_variance(patch_columns(values), labels, 2, std::vector<double>(4, 1.0), {0, 0, 1, 1});
}

TEST(PartitionTerms, WhatTellsMeshesApartIsNotExplained) {
    const BetweenPartVariance by_mesh = of_two_meshes(0, 1, 10, 11, {0, 0, 1, 1});
    EXPECT_NEAR(by_mesh.pooled, 0.0, 1e-15) << "a partition by style";
    EXPECT_NEAR(by_mesh.per_mesh, 0.0, 1e-15);
    const BetweenPartVariance by_part = of_two_meshes(0, 1, 10, 11, {0, 1, 0, 1});
    EXPECT_NEAR(by_part.pooled, 1.0, 1e-15);
    EXPECT_NEAR(by_part.per_mesh, 1.0, 1e-15);
}

TEST(PartitionTerms, PartsThatDifferTheOtherWayInAnotherMeshAreExplainedByItsOwnMeansOnly) {
    const BetweenPartVariance opposed = of_two_meshes(0, 1, 1, 0, {0, 1, 0, 1});
    EXPECT_NEAR(opposed.pooled, 0.0, 1e-15);
    EXPECT_NEAR(opposed.per_mesh, 1.0, 1e-15);
}

}  // namespace
}  // namespace coseg
