// Scores of parts against the ridge regression written out, and what is known of patches.

#include "solvers/partition/part_regression.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <numeric>

#include "solvers/partition/labelled_parts.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/base/seeded_random.hpp"

namespace coseg {
namespace {

/// Patches of four meshes with random features, in a row where each touches the next, in any place.
struct Patches {
    int count;
    SinglePrecisionFeatures features;
    std::vector<GlobalPatchNeighbors> neighbors;
    Eigen::Matrix3Xd positions;
    PositionFrame frame;
    std::vector<double> area;
    std::vector<int> mesh_of;
    std::vector<double> confidence;
    SaidParts said;

    Patches(int patches, int examples_of, std::uint64_t seed) : count(patches) {
        SeededStream random(seed);
        const auto numbers = [&](int rows) {
            Eigen::MatrixXd x(rows, count);
            for (Eigen::Index i = 0; i < x.size(); ++i) x(i) = random.uniform();
            return x;
        };
        features = {Comm(MPI_COMM_SELF), FeatureMatrices({numbers(3), numbers(2)})};
        positions = numbers(3);
        frame.mean = {0.1, 0.2, 0.3};
        frame.directions << 2, 0, 0, 0.3, 1, 0, 0, 0.1, 3;
        frame.correlation = {0.1, 0.5, 0.9};
        said.area = Eigen::MatrixXd::Zero(3, count);
        for (int i = 0; i < count; ++i) {
            area.push_back(0.5 + random.uniform());
            mesh_of.push_back(4 * i / count);
            confidence.push_back(random.uniform());
            if (i + 1 < count) neighbors.push_back({i, i + 1, 0.1 + random.uniform(), 0.0});
            if (i < examples_of) said.area(i % 2, i) = (i % 3 == 0 ? 0.3 : 1.0) * area.back();
        }
    }

    [[nodiscard]] Eigen::MatrixXd scores() const {
        return PartRegression({features, &positions, frame, area, mesh_of}, neighbors, confidence)
            .scores(said);
    }

    /// All that a score may look at, a column a patch.
    [[nodiscard]] Eigen::MatrixXd all_features() const {
        Eigen::MatrixXd x = Eigen::MatrixXd::Zero(13, count);
        for (int i = 0; i < count; ++i) {
            x.col(i).head(5) = features.all().col(i).cast<double>();
            double length = 0.0;
            for (const GlobalPatchNeighbors& n : neighbors) {
                if (n.patch_a != i && n.patch_b != i) continue;
                const int other = n.patch_a == i ? n.patch_b : n.patch_a;
                x.col(i).segment(5, 5) += n.boundary_length * features.all().col(other).cast<double>();
                length += n.boundary_length;
            }
            x.col(i).segment(5, 5) /= length;
            for (int k = 0; k < 3; ++k) {
                x(10 + k, i) = frame.correlation(k) / std::sqrt(3.0) *
                               frame.directions.col(k).dot(positions.col(i) - frame.mean);
            }
        }
        return x;
    }
};

/// Normal equations with an unpenalised constant as one more feature.
Eigen::MatrixXd regression(const Patches& patches) {
    const Eigen::MatrixXd x = patches.all_features();
    const double area = std::accumulate(patches.area.begin(), patches.area.end(), 0.0);
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(14, 14);
    normal.diagonal().head(13).setConstant(area / patches.count);
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(14, 3);
    Eigen::MatrixXd with_one(14, patches.count);
    with_one << x, Eigen::RowVectorXd::Ones(patches.count);
    for (int i = 0; i < patches.count; ++i) {
        Eigen::VectorXd target = patches.said.area.col(i);
        if (!patches.said.base.empty())  // a tenth of one of four shapes
            target(patches.said.base[at(i)]) += 0.1 / 4.0 * patches.area[at(i)] * patches.confidence[at(i)];
        normal += target.sum() * with_one.col(i) * with_one.col(i).transpose();
        right += with_one.col(i) * target.transpose();
    }
    return (normal.lu().solve(right)).transpose() * with_one;
}

void expect_regression(const Patches& patches, int predicted_parts) {
    const Eigen::MatrixXd scores = patches.scores();
    const Eigen::MatrixXd expected = regression(patches);
    const std::vector<int> known = known_labels({patches.said.area}, patches.area);
    for (int i = 0; i < patches.count; ++i) {
        if (known[at(i)] < 0) {
            EXPECT_NEAR((scores.col(i) - expected.col(i)).head(predicted_parts).norm(), 0.0, 1e-5) << i;
            EXPECT_NEAR(scores.col(i).head(predicted_parts).sum(), 1.0, 1e-5);
            if (predicted_parts == 2) {
                EXPECT_EQ(scores(2, i), 1.0 / 3.0) << "a label without an example";
            }
        } else {
            EXPECT_EQ(scores(known[at(i)], i), 1.0);
            EXPECT_EQ(scores.col(i).sum(), 1.0);
        }
    }
}

TEST(PartRegression, IsTheRidgeRegressionOfWhatIsSaid) {
    for (const int examples : {7, 30}) expect_regression(Patches(40, examples, 5), 2);
}

TEST(PartRegression, OneLabelAloneSaysNothingOfOtherPatches) {
    Patches patches(40, 7, 5);
    patches.said.area.row(1).setZero();
    const Eigen::MatrixXd scores = patches.scores();
    for (int i = 0; i < patches.count; ++i) {
        const bool is_known = i < 7 && i % 2 == 0 && i % 3 != 0;
        EXPECT_EQ(scores(0, i), is_known ? 1.0 : 1.0 / 3.0) << i;
        EXPECT_EQ(scores(2, i), is_known ? 0.0 : 1.0 / 3.0) << i;
    }
}

TEST(PartRegression, LearnsFromTheBaseAsMuchAsFromATenthOfAShape) {
    for (const int examples : {0, 7}) {
        Patches patches(40, examples, 5);
        for (int i = 0; i < patches.count; ++i) patches.said.base.push_back((i / 2) % 3);
        expect_regression(patches, 3);
    }
}

TEST(PartRegression, PlacesOfShapesThatDoNotStandAlikeDoNotCount) {
    Patches patches(40, 12, 5);
    patches.frame.correlation.setZero();
    const Eigen::MatrixXd scores = patches.scores();
    patches.positions *= -3.0;
    EXPECT_EQ(patches.scores(), scores);
}

TEST(KnownLabels, AreThoseOfPatchesOfWhichHalfIsSaid) {
    ExampleLabels examples{(Eigen::MatrixXd(2, 4) << 0.5, 0.49, 0.3, 0.0, 0.0, 0.0, 0.4, 0.0).finished()};
    EXPECT_EQ(known_labels(examples, {1.0, 1.0, 1.0, 0.0}), (std::vector<int>{0, -1, 1, -1}));
}

TEST(PartRegression, OfNothingIsRefused) { EXPECT_THROW(Patches(10, 0, 5).scores(), Error); }

TEST(LabelledParts, TakeTheLabelsThatSuitThemBestEachAnother) {
    // Label 0 suits both parts, but part 0 more.
    const Eigen::MatrixXd scores = (Eigen::MatrixXd(2, 3) << 1.0, 0.8, 0.9, 0.0, 0.1, 0.1).finished();
    EXPECT_EQ(named_parts(scores, {1, 0, 0}, {1.0, 1.0, 1.0}), (std::vector<int>{1, 0, 0}));
}

/// Four patches of two meshes, of which the first is known to be 0, 1; nothing else speaks for any labels.
TEST(BaseChoice, TakesWhatHasTheKnownLabelsRightAgainstBetterScoresElsewhere) {
    PartitionObjective objective;
    objective.deviations = PatchDeviations(Eigen::MatrixXf::Zero(1, 4));
    objective.per_mesh = objective.pooled = Eigen::VectorXf::Zero(1);
    objective.ties.resize(4);
    objective.mesh_of = {0, 0, 1, 1};
    objective.area.assign(4, 1.0);
    objective.share.assign(4, 0.5);
    objective.meshes = 2;
    ExampleLabels examples{Eigen::MatrixXd::Zero(2, 4)};
    examples.area(0, 0) = examples.area(1, 1) = 1.0;
    const Eigen::MatrixXd scores =
        (Eigen::MatrixXd(2, 4) << 1.0, 0.0, 0.9, 0.6, 0.0, 1.0, 0.1, 0.4).finished();
    BaseChoice base(objective, examples, scores, 75.0);
    EXPECT_TRUE(base.offer({0, 0, 0, 0}));
    EXPECT_FALSE(base.offer({0, 0, 1, 1}));
    EXPECT_EQ(base.labels(), (std::vector<int>{0, 1, 0, 0})) << "known labels are held";
    EXPECT_TRUE(base.offer_parts({1, 0, 0, 0})) << "named 0, 1, 1, 1";
    EXPECT_EQ(base.labels(), (std::vector<int>{0, 1, 1, 1}));
    EXPECT_TRUE(base.offer(labels_of_best_scores(scores)));
    EXPECT_EQ(base.labels(), (std::vector<int>{0, 1, 0, 0}));
}

}  // namespace
}  // namespace coseg
