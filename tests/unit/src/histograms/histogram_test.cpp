#include "src/histograms/histogram.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "src/base/error.hpp"

namespace coseg {
namespace {

using Ints = std::vector<int>;

Eigen::VectorXd vector_of(std::initializer_list<double> values) {
    Eigen::VectorXd v(static_cast<Eigen::Index>(values.size()));
    std::copy(values.begin(), values.end(), v.begin());
    return v;
}

TEST(BinOfFace, BinsAreClosedAboveAndTheEndsTakeWhatLiesOutside) {
    const FeatureRange range{RangeKind::global_percentile, {0, 1, 2, 3}};
    EXPECT_EQ(range.bins(), 3);
    EXPECT_EQ(bin_of_face(vector_of({-5, 0, 0.5, 1, 1.5, 2, 2.5, 3, 99}), range),
              (Ints{0, 0, 0, 0, 1, 1, 2, 2, 2}));
}

TEST(BinOfFace, RepeatedEdgesLeaveBinsEmpty) {
    const FeatureRange range{RangeKind::equal_mass, {-1, 0, 0, 0, 2}};
    EXPECT_EQ(bin_of_face(vector_of({-0.5, 0, 1}), range), (Ints{0, 0, 3}));
    EXPECT_EQ(bin_of_face(vector_of({4, 4}), {RangeKind::equal_mass, {4, 4, 4}}), (Ints{0, 0}));
}

TEST(BinOfFace, RefusesWhatIsNoNumber) {
    const FeatureRange range{RangeKind::per_mesh_percentile, {0, 1}};
    EXPECT_THROW((void)bin_of_face(vector_of({0.5, std::nan("")}), range), Error);
    EXPECT_THROW((void)bin_of_face(vector_of({std::numeric_limits<double>::infinity()}), range), Error);
}

TEST(PatchHistograms, CountsWeightPerBinAndPatch) {
    const Ints bin{0, 2, 2, 1, 0};
    const Ints patch{0, 0, 0, 1, 1};
    Eigen::MatrixXd expected(3, 2);
    expected << 1, 5, 0, 4, 5, 0;
    EXPECT_EQ(patch_histograms(bin, patch, 2, 3, vector_of({1, 2, 3, 4, 5}), HistogramScaling::counts),
              expected);
}

TEST(PatchHistograms, ScalingsHaveUnitSumAndUnitNorm) {
    const Ints bin{0, 2, 2, 1, 0};
    const Ints patch{0, 0, 0, 1, 1};
    const Eigen::VectorXd weights = vector_of({1, 2, 3, 4, 5});
    const Eigen::MatrixXd sum = patch_histograms(bin, patch, 2, 3, weights, HistogramScaling::unit_sum);
    const Eigen::MatrixXd root = patch_histograms(bin, patch, 2, 3, weights);
    EXPECT_NEAR(sum(2, 0), 5.0 / 6.0, 1e-15);
    for (int p = 0; p < 2; ++p) {
        EXPECT_NEAR(sum.col(p).sum(), 1.0, 1e-15);
        EXPECT_NEAR(root.col(p).norm(), 1.0, 1e-15);
    }
    EXPECT_LT((root.cwiseAbs2() - sum).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(PatchHistograms, OnlyPatchesWithoutFacesAreZero) {
    const Ints bin{0, 1, 1};
    const Ints patch{0, 0, 2};
    const Eigen::MatrixXd histogram = patch_histograms(bin, patch, 3, 2, vector_of({0, 0, 1}));
    EXPECT_NEAR(histogram(0, 0), std::sqrt(0.5), 1e-15);
    EXPECT_NEAR(histogram(1, 0), std::sqrt(0.5), 1e-15);
    EXPECT_EQ(histogram.col(1).norm(), 0.0);
    EXPECT_EQ(histogram(1, 2), 1.0);
}

TEST(PatchHistograms, RefusesWhatDoesNotFit) {
    const Eigen::VectorXd ones = Eigen::VectorXd::Ones(2);
    EXPECT_THROW((void)patch_histograms({0, 1}, {0, 0}, 1, 1, ones), Error);
    EXPECT_THROW((void)patch_histograms({0, 0}, {0, 1}, 1, 1, ones), Error);
    EXPECT_THROW((void)patch_histograms({0, -1}, {0, 0}, 1, 1, ones), Error);
    EXPECT_THROW((void)patch_histograms({0}, {0, 0}, 1, 1, ones), Error);
    EXPECT_THROW((void)patch_histograms({0}, {0}, 1, 1, ones), Error);
}

}  // namespace
}  // namespace coseg
