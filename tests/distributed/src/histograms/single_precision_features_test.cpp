#include "src/histograms/single_precision_features.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "src/parallel/comm.hpp"

namespace coseg {
namespace {

std::vector<Eigen::MatrixXd> two_features(Eigen::Index patches) {
    std::vector<Eigen::MatrixXd> matrices = {Eigen::MatrixXd(3, patches), Eigen::MatrixXd(2, patches)};
    for (Eigen::Index i = 0; i < patches; ++i) {
        matrices[0].col(i) << 1.0 / (3.0 + static_cast<double>(i)), 0.1 * static_cast<double>(i), 0.0;
        matrices[1].col(i) << -1e-20, 1.0 + static_cast<double>(i);
    }
    return matrices;
}

TEST(SinglePrecisionFeatures, AreTheFeaturesRoundedOnEveryRank) {
    const Comm comm(MPI_COMM_WORLD);
    for (const Eigen::Index patches : {1, 2, 61}) {  // some ranks round nothing, or several patches
        const std::vector<Eigen::MatrixXd> exact = two_features(patches);
        const SinglePrecisionFeatures features(comm, share_matrices(comm, exact));
        ASSERT_EQ(features.size(), 2U);
        EXPECT_EQ(Eigen::MatrixXf(features[0]), exact[0].cast<float>());
        EXPECT_EQ(Eigen::MatrixXf(features[1]), exact[1].cast<float>());
        EXPECT_EQ(Eigen::MatrixXf(features.all().topRows(3)), exact[0].cast<float>());
        EXPECT_EQ(Eigen::MatrixXf(features.all().bottomRows(2)), exact[1].cast<float>());
    }
}

TEST(SinglePrecisionFeatures, OutliveThoseThatTheyAreRoundedFrom) {
    const Comm comm(MPI_COMM_WORLD);
    SinglePrecisionFeatures kept;
    EXPECT_TRUE(kept.empty());
    EXPECT_EQ(kept.all().size(), 0);
    {
        const SinglePrecisionFeatures features(comm, share_matrices(comm, two_features(7)));
        kept = features;
    }
    EXPECT_EQ(Eigen::MatrixXf(kept[1]), two_features(7)[1].cast<float>());
}

}  // namespace
}  // namespace coseg
