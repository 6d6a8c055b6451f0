#include "src/histograms/feature_range.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace coseg {
namespace {

using Doubles = std::vector<double>;

TEST(WeightedQuantiles, AreTheSmallestValuesThatCompleteAFraction) {
    const Doubles values{5, 1, 4, 2, 3};
    EXPECT_EQ(weighted_quantiles(values, Doubles{1, 1, 1, 1, 1}, Doubles{0, 0.2, 0.21, 0.6, 1}),
              (Doubles{1, 1, 2, 3, 5}));
    EXPECT_EQ(weighted_quantiles(values, Doubles{0, 8, 0, 1, 1}, Doubles{0.5, 0.8, 0.85, 0.95, 1}),
              (Doubles{1, 1, 2, 3, 5}));
}

TEST(WeightedQuantiles, WithoutWeightAllValuesCountAlike) {
    EXPECT_EQ(weighted_quantiles(Doubles{3, 1, 2, 4}, Doubles{0, 0, 0, 0}, Doubles{0.25, 0.5, 1}),
              (Doubles{1, 2, 4}));
    EXPECT_EQ(weighted_quantiles(Doubles{7}, Doubles{2}, Doubles{0, 0.5, 1}), (Doubles{7, 7, 7}));
}

TEST(RescalePerMesh, MapsPercentilesToZeroAndOneAndClamps) {
    Eigen::VectorXd values = Eigen::VectorXd::LinSpaced(1000, 1.0, 1000.0);
    const Eigen::VectorXd area = Eigen::VectorXd::Constant(1000, 0.001);
    values[999] = 1e6;
    rescale_per_mesh(values, area);
    EXPECT_EQ(values[9], 0.0);
    EXPECT_EQ(values[989], 1.0);
    EXPECT_EQ(values[0], 0.0);
    EXPECT_EQ(values[999], 1.0);
    EXPECT_NEAR(values[499], 0.5, 1e-12);
}

TEST(RescalePerMesh, WeighsByArea) {
    Eigen::VectorXd values(4);
    values << 0, 1, 2, 3;
    Eigen::VectorXd area(4);
    area << 0.001, 0.5, 0.498, 0.001;
    rescale_per_mesh(values, area);
    EXPECT_EQ(values, Eigen::Vector4d(0, 0, 1, 1));
}

TEST(RescalePerMesh, ConstantUpToRoundingBecomesZero) {
    Eigen::VectorXd constant = Eigen::VectorXd::Constant(50, 3.0);
    constant[7] += 1e-15;
    constant[31] -= 1e-15;
    rescale_per_mesh(constant, Eigen::VectorXd::Ones(50));
    EXPECT_EQ(constant, Eigen::VectorXd::Zero(50));
    Eigen::VectorXd noise = Eigen::VectorXd::Random(50) * 1e-15;
    rescale_per_mesh(noise, Eigen::VectorXd::Ones(50));
    EXPECT_EQ(noise, Eigen::VectorXd::Zero(50));
    Eigen::VectorXd none;
    rescale_per_mesh(none, Eigen::VectorXd());
    EXPECT_EQ(none.size(), 0);
}

}  // namespace
}  // namespace coseg
