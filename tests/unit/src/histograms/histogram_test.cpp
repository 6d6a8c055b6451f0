#include "src/histograms/histogram.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "src/base/error.hpp"
#include "src/base/seeded_random.hpp"

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
    const HistogramOptions counts{HistogramScaling::counts, 0.0};
    EXPECT_EQ(patch_histograms(bin, patch, 2, 3, vector_of({1, 2, 3, 4, 5}), counts), expected);
}

TEST(PatchHistograms, ScalingsHaveUnitSumAndUnitNorm) {
    const Ints bin{0, 2, 2, 1, 0};
    const Ints patch{0, 0, 0, 1, 1};
    const Eigen::VectorXd weights = vector_of({1, 2, 3, 4, 5});
    const Eigen::MatrixXd sum =
        patch_histograms(bin, patch, 2, 3, weights, {HistogramScaling::unit_sum, 0.0});
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

TEST(PatchHistograms, SmoothingKeepsTheMassAndFallsOffToBothSides) {
    const int bins = 20;
    Ints bin;
    for (int f = 0; f < 40; ++f) bin.push_back(static_cast<int>(hash_words({3, std::uint64_t(f)}) % bins));
    bin.insert(bin.end(), {10, 0, 19});
    Ints patch(40, 0);
    patch.insert(patch.end(), {1, 2, 3});
    const auto weights = Eigen::VectorXd::Ones(43);
    const HistogramOptions options{HistogramScaling::counts, 1.5};
    const Eigen::MatrixXd smooth = patch_histograms(bin, patch, 4, bins, weights, options);
    EXPECT_NEAR(smooth.col(0).sum(), 40.0, 1e-12);
    for (int p = 1; p < 4; ++p) EXPECT_NEAR(smooth.col(p).sum(), 1.0, 1e-12);
    for (int k = 1; k < 4; ++k) {
        EXPECT_NEAR(smooth(10 + k, 1), smooth(10 - k, 1), 1e-15);
        EXPECT_NEAR(smooth(10 + k, 1) / smooth(10, 1), std::exp(-0.5 * k * k / 2.25), 1e-12);
    }
    EXPECT_LT((smooth.col(2) - smooth.col(3).reverse()).cwiseAbs().maxCoeff(), 1e-15);
    EXPECT_GT(smooth(0, 2), smooth(1, 2));
    EXPECT_GT(smooth.minCoeff(), -1e-300);
    // More smoothing than bins still keeps everything inside.
    EXPECT_NEAR(patch_histograms(bin, patch, 4, bins, weights, {HistogramScaling::counts, 30.0}).sum(), 43.0,
                1e-10);
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
