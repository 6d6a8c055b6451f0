#include <gtest/gtest.h>

#include <Eigen/QR>

#include "solvers/spectral/normalized_cut.hpp"
#include "src/base/seeded_random.hpp"
#include "tests/support/graphs.hpp"

namespace coseg {
namespace {

/// Indicator coordinates of `truth` with noise, turned by a rotation of the space: what eigenvectors look
/// like.
SpectralEmbedding turned_indicators(const std::vector<int>& truth, int clusters, double noise,
                                    std::uint64_t seed) {
    SpectralEmbedding e;
    Eigen::MatrixXd turn(clusters, clusters);
    SeededStream random(seed);
    for (int a = 0; a < clusters; ++a) {
        for (int b = 0; b < clusters; ++b) turn(a, b) = random.normal();
    }
    turn = Eigen::MatrixXd(turn.householderQr().householderQ());
    Eigen::MatrixXd points = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(truth.size()), clusters);
    for (std::size_t i = 0; i < truth.size(); ++i) {
        e.rows.push_back(static_cast<int>(i));
        e.degrees.push_back(1.0 + random.uniform());
        for (int c = 0; c < clusters; ++c) points(static_cast<Eigen::Index>(i), c) = noise * random.normal();
        points(static_cast<Eigen::Index>(i), truth[i]) += 0.2 + random.uniform();
    }
    e.coordinates = points * turn;
    e.eigenvalues.assign(static_cast<std::size_t>(clusters), 1.0);
    return e;
}

TEST(Discretization, FindsTheAxesInAnyRotation) {
    for (const int clusters : {2, 3, 5, 12}) {
        std::vector<int> truth;
        for (int i = 0; i < 30 * clusters; ++i) truth.push_back(i % clusters);
        for (std::uint64_t seed = 0; seed < 5; ++seed) {
            const std::vector<int> found =
                discretize(turned_indicators(truth, clusters, 0.02, seed), clusters);
            EXPECT_TRUE(testing_graphs::same_partition(found, truth))
                << clusters << " clusters, seed " << seed;
        }
    }
}

TEST(Discretization, OneClusterTakesAll) {
    const std::vector<int> truth = {0, 1, 0, 1};
    EXPECT_EQ(discretize(turned_indicators(truth, 2, 0.0, 1), 1), std::vector<int>(4, 0));
}

TEST(Discretization, RowsSetAsideHaveNoLabel) {
    SpectralEmbedding e = turned_indicators({0, 1, 0}, 2, 0.0, 4);
    e.rows = {1, 3, 4};
    const std::vector<int> labels = cut_embedding(e, 2, 6);
    EXPECT_EQ(labels[0], -1);
    EXPECT_EQ(labels[2], -1);
    EXPECT_EQ(labels[5], -1);
    EXPECT_EQ(labels[1], labels[4]);
    EXPECT_NE(labels[1], labels[3]);
}

}  // namespace
}  // namespace coseg
