#include "solvers/alignment/place_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "solvers/alignment/rotation_fit.hpp"
#include "src/base/seeded_random.hpp"

namespace coseg {
namespace {

/// A seat at height 0, four legs down to -1.2, and on request a back up to 1.2.
WeighedPlaces chair_places(bool with_back, std::uint64_t seed) {
    SeededStream random(seed);
    const int count = with_back ? 60 : 40;
    WeighedPlaces made{Eigen::Matrix3Xd(3, count), Eigen::VectorXd::Constant(count, 1.0 / count)};
    for (int p = 0; p < count; ++p) {
        const double a = 1.6 * random.uniform() - 0.8;
        const double b = random.uniform();
        if (p < 20) {
            made.positions.col(p) << a, 0.0, 1.6 * b - 0.8;
        } else if (p < 40) {
            made.positions.col(p) << (p % 2 == 0 ? 0.8 : -0.8), -1.2 * b, (p % 4 < 2 ? 0.8 : -0.8);
        } else {
            made.positions.col(p) << a, 1.2 * b, -0.8;
        }
    }
    return made;
}

TEST(PlaceFit, TurnsAChairBackToWhereOthersStand) {
    const WeighedPlaces others = chair_places(true, 1);
    for (const Eigen::Matrix3d& turn : hashed_rotations(4, 7)) {
        WeighedPlaces own = chair_places(true, 2);
        own.positions = turn * own.positions;
        const std::vector<FittedPlaces> found = fitted_places(own, others, hashed_rotations(80, 3));
        ASSERT_EQ(found.size(), 20U);
        EXPECT_LT(angle_between(found.front().rotation, turn.transpose()), 10.0);
        for (std::size_t k = 1; k < found.size(); ++k)
            EXPECT_LE(found[k].likelihood, found[k - 1].likelihood);
    }
}

TEST(PlaceFit, StandsAStoolOnItsLegsThoughItsMiddleIsLower) {
    const WeighedPlaces others = chair_places(true, 1);
    WeighedPlaces own = chair_places(false, 2);
    own.positions.colwise() -= own.positions.rowwise().mean().eval();
    const Eigen::Matrix3d turn = hashed_rotations(1, 11).front();
    own.positions = turn * own.positions;
    const Eigen::Matrix3d found = fitted_places(own, others, hashed_rotations(80, 3)).front().rotation * turn;
    EXPECT_GT(found(1, 1), 0.95);  // what is up stays up; a quarter of a turn about it is as good
}

TEST(PlaceFit, SaysWhatPlacesFarFromAllOthersAreWorth) {
    const WeighedPlaces one{Eigen::Vector3d(0.0, 0.0, 0.0), Eigen::VectorXd::Ones(1)};
    const WeighedPlaces far{Eigen::Vector3d(1000.0, 0.0, 0.0), Eigen::VectorXd::Ones(1)};
    const std::vector<Eigen::Matrix3d> still = {Eigen::Matrix3d::Identity()};
    EXPECT_NEAR(fitted_places(one, one, still).front().likelihood, std::log(1.02), 1e-12);
    EXPECT_NEAR(fitted_places(one, far, still).front().likelihood, std::log(0.02), 1e-12);
}

}  // namespace
}  // namespace coseg
