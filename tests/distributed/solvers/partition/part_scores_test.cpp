// Scores of parts against the ridge regression written out, group by group, and what no other mesh confirms.

#include "solvers/partition/part_scores.hpp"

#include <gtest/gtest.h>
#include <mpi.h>

#include <Eigen/LU>
#include <cmath>

#include "src/base/index.hpp"
#include "src/base/seeded_random.hpp"

namespace coseg {
namespace {

constexpr int mesh_count = 23;
constexpr int in_a_mesh = 6;
constexpr int patch_count = mesh_count * in_a_mesh;

/// TwoParts of two parts: feature 0 says which, as far as `told` goes; the rest is noise.
struct TwoParts {
    SinglePrecisionFeatures features;
    Eigen::Matrix3Xd positions{3, patch_count};
    PositionFrame frame;
    std::vector<double> area;
    std::vector<int> mesh_of;
    std::vector<int> part;

    explicit TwoParts(double told) {
        SeededStream random(7);
        Eigen::MatrixXd x(4, patch_count);
        for (int i = 0; i < patch_count; ++i) {
            part.push_back(random.uniform() < 0.4 ? 1 : 0);
            mesh_of.push_back(i / in_a_mesh);
            area.push_back(0.5 + random.uniform());
            for (int d = 0; d < 4; ++d) x(d, i) = random.uniform();
            x(0, i) += told * part.back();
            for (int d = 0; d < 3; ++d) positions(d, i) = random.uniform();
        }
        features = {Comm(MPI_COMM_SELF),
                    FeatureMatrices({Eigen::MatrixXd(x.topRows(1)), Eigen::MatrixXd(x.bottomRows(3))})};
        frame.mean = {0.1, 0.2, 0.3};
        frame.correlation = {0.1, 0.5, 0.9};
    }
    [[nodiscard]] PatchLooks looks() const { return {features, &positions, frame, area, mesh_of}; }

    [[nodiscard]] Eigen::MatrixXd all_numbers() const {
        Eigen::MatrixXd x(8, patch_count);
        x.topRows(4) = features.all().cast<double>();
        for (int i = 0; i < patch_count; ++i)
            x.col(i).segment<3>(4) =
                ((positions.col(i) - frame.mean).array() * frame.correlation.array()).matrix() /
                std::sqrt(3.0);
        x.row(7).setOnes();
        return x;
    }
};

TEST(PartScores, AreTheRidgeRegressionOverTheOtherGroupsOfMeshes) {
    const TwoParts p(0.3);
    const Eigen::MatrixXf scores = part_scores(Comm(MPI_COMM_WORLD), p.looks(), p.part, 2);
    const Eigen::MatrixXd x = p.all_numbers();
    double total = 0.0;
    for (const double a : p.area) total += a;
    for (int i = 0; i < patch_count; i += 5) {
        Eigen::MatrixXd gram = 30.0 * Eigen::MatrixXd::Identity(8, 8);
        Eigen::MatrixXd moment = Eigen::MatrixXd::Zero(8, 2);
        for (int j = 0; j < patch_count; ++j) {
            if (p.mesh_of[at(j)] % 10 == p.mesh_of[at(i)] % 10) continue;
            const double weight = p.area[at(j)] * patch_count / total;
            gram += weight * x.col(j) * x.col(j).transpose();
            moment.col(p.part[at(j)]) += weight * x.col(j);
        }
        const Eigen::VectorXd expected = (gram.inverse() * moment).transpose() * x.col(i);
        EXPECT_NEAR(scores(0, i), expected(0), 1e-4) << i;
        EXPECT_NEAR(scores(1, i), expected(1), 1e-4) << i;
    }
}

TEST(PartScores, HaveTheSameBytesOnAnyNumberOfRanks) {
    const TwoParts p(0.3);
    const Eigen::MatrixXf together = part_scores(Comm(MPI_COMM_WORLD), p.looks(), p.part, 2);
    const Eigen::MatrixXf alone = part_scores(Comm(MPI_COMM_SELF), p.looks(), p.part, 2);
    EXPECT_TRUE((together.array() == alone.array()).all());
}

TEST(PartScores, TellPartsApartWhereTheFeaturesDo) {
    const auto right = [](double told) {
        const TwoParts p(told);
        const Eigen::MatrixXf scores = part_scores(Comm(MPI_COMM_WORLD), p.looks(), p.part, 2);
        int count = 0;
        for (int i = 0; i < patch_count; ++i)
            count += (scores(1, i) > scores(0, i)) == (p.part[at(i)] == 1) ? 1 : 0;
        return static_cast<double>(count) / patch_count;
    };
    EXPECT_GT(right(3.0), 0.97);
    EXPECT_LT(right(0.0), 0.75);
}

TEST(PartScores, OfAPartThatOneMeshAloneHasAreLow) {
    TwoParts p(3.0);
    for (int i = 0; i < in_a_mesh; ++i) p.part[at(i)] = 2;
    const Eigen::MatrixXf scores = part_scores(Comm(MPI_COMM_WORLD), p.looks(), p.part, 3);
    for (int i = 0; i < in_a_mesh; ++i) EXPECT_LT(scores(2, i), 0.05) << i;
}

TEST(PartScores, NeedTwoMeshes) {
    TwoParts p(3.0);
    p.mesh_of.assign(at(patch_count), 0);
    EXPECT_EQ(part_scores(Comm(MPI_COMM_WORLD), p.looks(), p.part, 2).size(), 0);
}

}  // namespace
}  // namespace coseg
