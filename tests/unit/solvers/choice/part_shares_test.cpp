#include "solvers/choice/part_shares.hpp"

#include <gtest/gtest.h>

namespace coseg {
namespace {

TEST(PartShares, SharesAreMeansOverMeshesOfAnySize) {
    const std::vector<double> shares =
        mean_area_shares({0, 1, 0, 1, 1}, 2, {1.0, 3.0, 50.0, 25.0, 25.0}, {0, 0, 1, 1, 1});
    EXPECT_DOUBLE_EQ(shares[0], 0.5 * (0.25 + 0.5));
    EXPECT_DOUBLE_EQ(shares[1], 0.5 * (0.75 + 0.5));
}

TEST(PartShares, PartsAreNumberedByShareThenByLowestPatch) {
    const std::vector<int> labels = {3, 0, 0, 1, 3};
    EXPECT_EQ(
        canonical_labels(labels, 4, {1.0, 1.0, 1.0, 2.0, 5.0}, {0, 0, 0, 0, 0}),
        (std::vector<int>{0, 1, 1, 2, 0}));  // shares .6, .2, .2: the tie goes to patch 1 before patch 3
    const std::vector<int> renamed = {1, 2, 2, 0, 1};
    EXPECT_EQ(canonical_labels(renamed, 3, {1.0, 1.0, 1.0, 2.0, 5.0}, {0, 0, 0, 0, 0}),
              (std::vector<int>{0, 1, 1, 2, 0}));
}

TEST(PartShares, LabelsAreRenumberedInTheOrderInWhichTheyOccur) {
    EXPECT_EQ(renumbered({4, 0, 4, 7, 0}), (std::vector<int>{0, 1, 0, 2, 1}));
    EXPECT_TRUE(renumbered({}).empty());
}

TEST(PartShares, APartIsDegenerateWhereItIsTinyOrInTheFewestMeshes) {
    Eigen::MatrixXd shares(2, 4);
    shares << 0.5, 0.4, 0.0, 0.0,  //
        0.5, 0.6, 1.0, 1.0;
    EXPECT_FALSE(is_degenerate(shares)) << "half of the meshes have both";
    shares.col(1) << 0.0, 1.0;
    EXPECT_TRUE(is_degenerate(shares));
    shares.row(0).setConstant(0.0049);
    shares.row(1).setConstant(0.9951);
    EXPECT_TRUE(is_degenerate(shares));
    shares.row(0).setConstant(0.0051);
    EXPECT_FALSE(is_degenerate(shares));
}

}  // namespace
}  // namespace coseg
