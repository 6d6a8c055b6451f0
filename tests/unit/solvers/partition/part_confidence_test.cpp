#include "solvers/partition/part_confidence.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace coseg {
namespace {

/// Four patches of one mesh; patch 0 has ties to 1 and, three times as strong, to 2. Patch 3 has none.
PartitionObjective tied_patches() {
    PartitionObjective objective;
    objective.deviations = PatchDeviations(Eigen::MatrixXf::Zero(1, 4));
    objective.per_mesh = objective.pooled = Eigen::VectorXf::Ones(1);
    objective.ties = {{{1, 1.0}, {2, 3.0}}, {{0, 1.0}}, {{0, 3.0}}, {}};
    objective.mesh_of = {0, 0, 0, 0};
    objective.area = {1.0, 1.0, 1.0, 2.0};
    objective.share = {0.2, 0.2, 0.2, 0.4};
    objective.meshes = 1;
    return objective;
}

double logistic(double x) { return 1.0 / (1.0 + std::exp(-x)); }

TEST(PartConfidence, GrowsWithTheShareOfTiesThatStayInThePart) {
    const std::vector<double> c = part_confidence(tied_patches(), {}, {0, 0, 1, 1}, 2);
    EXPECT_NEAR(c[0], logistic(-7.84 + 10.0 * 0.25), 1e-12);
    EXPECT_NEAR(c[1], logistic(-7.84 + 10.0), 1e-12) << "all of its ties";
    EXPECT_NEAR(c[2], logistic(-7.84), 1e-12) << "none of its ties";
    EXPECT_NEAR(c[3], logistic(-7.84 + 10.0), 1e-12) << "it has no ties that speak against it";
}

TEST(PartConfidence, GrowsWithWhatThePatchGainsMoreThanInTheNextBestPart) {
    PartitionObjective objective = tied_patches();
    KnownParts known{{}, Eigen::MatrixXd::Zero(3, 4)};
    known.gain.col(3) << 1.0, 13.0, 2.0;  // of two fifths of the area
    std::vector<double> c = part_confidence(objective, known, {0, 0, 1, 1}, 3);
    EXPECT_NEAR(c[3], logistic(-7.84 + 10.0 + 1.26 * std::tanh(11.0 * 2.5 / 60.0)), 1e-12);
    // Two patches that differ from two others.
    objective.deviations = PatchDeviations(Eigen::RowVector4f(1.0F, 1.0F, -1.0F, -2.0F));
    c = part_confidence(objective, {}, {0, 0, 1, 1}, 2);
    // Patch 3 in part 1 (sum -3, area 3) and in part 0 (sum 2, area 2), both norms counted.
    const double in_one = 2.0 * (2.0 * 6.0 / 3.0 - 2.0 * 9.0 / 9.0);
    const double in_zero = 2.0 * (-2.0 * 4.0 / 2.0 - 2.0 * 4.0 / 4.0);
    EXPECT_NEAR(c[3], logistic(-7.84 + 10.0 + 1.26 * std::tanh((in_one - in_zero) * 2.5 / 60.0)), 1e-6);
}

TEST(PartConfidence, IsOneForAPatchWhoseLabelIsGiven) {
    const KnownParts known{{-1, 0, -1, -1}, {}};
    EXPECT_EQ(part_confidence(tied_patches(), known, {0, 0, 1, 1}, 2)[1], 1.0);
}

}  // namespace
}  // namespace coseg
