#include "solvers/alignment/rotation_chain.hpp"

#include <gtest/gtest.h>

#include "solvers/alignment/rotation_fit.hpp"
#include "solvers/alignment/spectral_rotations.hpp"

namespace coseg {
namespace {

/// Shape m stands as G_m^T, so that G_to^T G_from turns `from` to stand like `to`.
PairRotation pair_of(const std::vector<Eigen::Matrix3d>& g, int from, int to, double agreement) {
    return {from, to, g[static_cast<std::size_t>(to)].transpose() * g[static_cast<std::size_t>(from)],
            agreement};
}

TEST(RotationChain, FollowsTheBestPairs) {
    const std::vector<Eigen::Matrix3d> g = hashed_rotations(5, 2);
    PairRotation wrong = pair_of(g, 0, 3, 0.1);
    wrong.rotation = g[4];
    const std::vector<PairRotation> pairs{pair_of(g, 0, 1, 0.5), pair_of(g, 2, 1, 0.4), wrong,
                                          pair_of(g, 2, 3, 0.3)};
    const ChainedRotations chained = chained_rotations(5, pairs);
    const Eigen::Matrix3d frame = chained.rotations[0] * g[0].transpose();
    for (std::size_t m = 0; m < 4; ++m) {
        EXPECT_TRUE(chained.reached[m]);
        EXPECT_TRUE(chained.rotations[m].isApprox(frame * g[m], 1e-12)) << m;
    }
    EXPECT_FALSE(chained.reached[4]);
    EXPECT_TRUE(chained.rotations[4].isIdentity());
}

TEST(SpectralRotations, AreThoseOfTheMomentsButForOneRotationOfAll) {
    constexpr int shapes = 7;
    const std::vector<Eigen::Matrix3d> g = hashed_rotations(shapes, 8);
    const Eigen::Matrix3d spread = Eigen::Vector3d(3.0, 2.0, 1.0).asDiagonal();
    std::vector<PairMoment> moments;
    for (int a = 0; a < shapes; ++a) {
        for (const int step : {1, 3}) {
            const int b = (a + step) % shapes;
            const auto from = static_cast<std::size_t>(a);
            moments.push_back({a, b, g[from].transpose() * spread * g[static_cast<std::size_t>(b)]});
        }
    }
    const std::vector<Eigen::Matrix3d> found = spectral_rotations(shapes, moments, 1);
    const Eigen::Matrix3d frame = found[0] * g[0].transpose();
    for (std::size_t m = 0; m < g.size(); ++m) EXPECT_LT(angle_between(found[m], frame * g[m]), 0.01) << m;
}

}  // namespace
}  // namespace coseg
