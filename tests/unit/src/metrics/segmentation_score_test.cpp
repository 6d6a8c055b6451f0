#include "src/metrics/segmentation_score.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "src/base/error.hpp"

namespace coseg {
namespace {

LabelledShape shape(std::string name, std::vector<int> truth, std::vector<int> labels,
                    std::vector<double> area) {
    return {std::move(name), std::move(truth), std::move(labels), std::move(area)};
}

std::string sentence_of(const std::vector<LabelledShape>& shapes) {
    try {
        score_segmentation(shapes);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::input);
        return error.what();
    }
    return "";
}

TEST(SegmentationScore, IsOneForTheTruthUnderOtherNumbers) {
    const SegmentationScore score = score_segmentation({shape("a", {0, 1, 2}, {5, 9, 7}, {1.0, 2.0, 3.0}),
                                                        shape("b", {2, 2, 0}, {7, 7, 5}, {4.0, 1.0, 1.0})});
    EXPECT_DOUBLE_EQ(score.one_to_one, 1.0);
    EXPECT_DOUBLE_EQ(score.many_to_one, 1.0);
    EXPECT_DOUBLE_EQ(score.rand_index, 1.0);
    EXPECT_DOUBLE_EQ(score.face_rand_index, 1.0);
    EXPECT_EQ(score.clusters, 3);
    EXPECT_EQ(score.truth_labels, 3);
}

TEST(SegmentationScore, IsNoMoreThanOne) {
    // Areas whose shares sum to more than 1, by rounding.
    for (int faces = 3; faces < 200; ++faces) {
        std::vector<int> labels(static_cast<std::size_t>(faces));
        std::vector<double> areas;
        for (int f = 0; f < faces; ++f) {
            labels[static_cast<std::size_t>(f)] = f % 7;
            areas.push_back(0.1 + 1.0 / (f + 3));
        }
        const LabelledShape all = shape("a", labels, labels, areas);
        const SegmentationScore score = score_segmentation({all});
        EXPECT_LE(score.one_to_one, 1.0);
        EXPECT_LE(score.many_to_one, 1.0);
        EXPECT_LE(score.rand_index, 1.0);
        EXPECT_LE(upper_bound_of_labels(all), 1.0);
        EXPECT_LE(score_segmentation({shape("a", std::vector<int>(labels.size()), labels, areas)}).one_label,
                  1.0);
    }
}

TEST(SegmentationScore, WeighsFacesByTheirShareOfTheShape) {
    const SegmentationScore score =
        score_segmentation({shape("a", {0, 0, 1, 1}, {0, 1, 1, 1}, {50.0, 10.0, 20.0, 20.0})});
    EXPECT_DOUBLE_EQ(score.one_to_one, 0.9);
    EXPECT_DOUBLE_EQ(score.many_to_one, 0.9);
    EXPECT_DOUBLE_EQ(score.one_label, 0.6);
}

TEST(SegmentationScore, WeighsEveryShapeTheSameWhateverItsArea) {
    const SegmentationScore score = score_segmentation(
        {shape("large", {0, 1}, {0, 1}, {1e6, 1e6}), shape("small", {0, 1}, {0, 0}, {3e-6, 1e-6})});
    EXPECT_DOUBLE_EQ(score.shapes[0].one_to_one, 1.0);
    EXPECT_DOUBLE_EQ(score.shapes[1].one_to_one, 0.75);
    EXPECT_DOUBLE_EQ(score.one_to_one, 0.875);
}

TEST(SegmentationScore, UsesOneMappingForTheWholeCollection) {
    // Each shape alone is perfect, but in the second the numbers are swapped.
    const SegmentationScore score =
        score_segmentation({shape("a", {0, 1}, {0, 1}, {3.0, 1.0}), shape("b", {0, 1}, {0, 1}, {3.0, 1.0}),
                            shape("swapped", {0, 1}, {1, 0}, {3.0, 1.0})});
    EXPECT_DOUBLE_EQ(score.one_to_one, 2.0 / 3.0);
    EXPECT_DOUBLE_EQ(score.shapes[2].one_to_one, 0.0);
    EXPECT_DOUBLE_EQ(score.shapes[2].rand_index, 1.0);
}

TEST(SegmentationScore, CountsAPartLeftOverAsWrongButManyToOneAllowsIt) {
    const SegmentationScore score = score_segmentation({shape("a", {0, 0, 1}, {4, 5, 6}, {0.5, 0.25, 0.25})});
    EXPECT_DOUBLE_EQ(score.one_to_one, 0.75);
    EXPECT_DOUBLE_EQ(score.many_to_one, 1.0);
}

TEST(SegmentationScore, CountsAreaOfUnknownTruthButNeverAsRight) {
    const SegmentationScore score = score_segmentation({shape("a", {0, -1}, {0, 0}, {3.0, 1.0})});
    EXPECT_DOUBLE_EQ(score.one_to_one, 0.75);
    EXPECT_DOUBLE_EQ(score.many_to_one, 0.75);
    EXPECT_EQ(score.truth_labels, 1);
}

TEST(SegmentationScore, IgnoresPartsThatLieOnUnknownTruthOnly) {
    const SegmentationScore score = score_segmentation({shape("a", {0, -1}, {0, 8}, {3.0, 1.0})});
    EXPECT_EQ(score.clusters, 1);
}

TEST(SegmentationScore, CountsAShapeWithoutLabelsAsZero) {
    const SegmentationScore score =
        score_segmentation({shape("a", {0, 1}, {0, 1}, {1.0, 1.0}), {"gone", {0, 1}, std::nullopt, {}}});
    EXPECT_TRUE(score.shapes[1].missing);
    EXPECT_DOUBLE_EQ(score.one_to_one, 0.5);
    EXPECT_DOUBLE_EQ(score.rand_index, 0.5);
}

TEST(SegmentationScore, IsZeroWhereNothingCanBeRight) {
    EXPECT_DOUBLE_EQ(score_segmentation({}).one_to_one, 0.0);
    EXPECT_DOUBLE_EQ(score_segmentation({{"gone", {0}, std::nullopt, {}}}).one_to_one, 0.0);
    const SegmentationScore unknown = score_segmentation({shape("a", {-1}, {0}, {1.0})});
    EXPECT_DOUBLE_EQ(unknown.one_to_one, 0.0);
    EXPECT_EQ(unknown.clusters, 0);
}

TEST(SegmentationScore, NamesTheShapeWhoseLengthsDiffer) {
    const std::string labels = sentence_of({shape("chair", {0, 1}, {0}, {1.0, 1.0})});
    EXPECT_NE(labels.find("'chair' has 2 truth labels but 1 labels"), std::string::npos) << labels;
    const std::string faces = sentence_of({shape("chair", {0, 1}, {0, 1}, {1.0, 1.0, 1.0})});
    EXPECT_NE(faces.find("'chair' has 2 truth labels but 3 faces"), std::string::npos) << faces;
}

TEST(SegmentationScore, NamesTheShapeWithoutAreaAndTheFaceWithoutAFiniteOne) {
    const std::string flat = sentence_of({shape("flat", {0, 1}, {0, 1}, {0.0, 0.0})});
    EXPECT_NE(flat.find("'flat' has no area"), std::string::npos) << flat;
    const std::string nan =
        sentence_of({shape("bad", {0, 1}, {0, 1}, {1.0, std::numeric_limits<double>::quiet_NaN()})});
    EXPECT_NE(nan.find("face 1 of 'bad'"), std::string::npos) << nan;
}

TEST(SegmentationScore, UpperBoundGivesEveryPatchItsMajority) {
    // patch 0: 3 of truth 0, 1 of truth 1; patch 1: 2 of truth 1; patch 2: 4 without truth
    const LabelledShape one = shape("a", {0, 1, 1, -1}, {0, 0, 1, 2}, {3.0, 1.0, 2.0, 4.0});
    EXPECT_DOUBLE_EQ(upper_bound_of_labels(one), 0.5);
    EXPECT_DOUBLE_EQ(upper_bound_of_labels({.name = "b", .truth = {}, .labels = {}, .face_area = {}}), 0.0);
}

}  // namespace
}  // namespace coseg
