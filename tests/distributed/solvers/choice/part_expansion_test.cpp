// Expansions against the best of all labellings, and against the score that they are to raise.

#include "solvers/choice/part_expansion.hpp"

#include <gtest/gtest.h>

#include "src/base/index.hpp"
#include "src/base/seeded_random.hpp"

namespace coseg {
namespace {

/// Ties and gains alone: no descriptors, no sizes, no links.
struct TiedPatches {
    PartitionObjective objective;
    KnownParts known;

    TiedPatches(int meshes, int patches_of_mesh, int parts, std::uint64_t seed) {
        const int patches = meshes * patches_of_mesh;
        SeededStream random(seed);
        objective.deviations = PatchDeviations(Eigen::MatrixXf::Zero(1, patches));
        objective.per_mesh = objective.pooled = Eigen::VectorXf::Zero(1);
        objective.ties.resize(at(patches));
        objective.area.assign(at(patches), 1.0);
        objective.share.assign(at(patches), 1.0 / patches_of_mesh);
        objective.meshes = meshes;
        known.gain = Eigen::MatrixXd(parts, patches);
        for (int i = 0; i < patches; ++i) {
            objective.mesh_of.push_back(i / patches_of_mesh);
            for (int part = 0; part < parts; ++part) known.gain(part, i) = random.uniform();
        }
        for (int i = 0; i < patches; ++i) {
            for (int j = i + 1; j < patches; ++j) {
                if (objective.mesh_of[at(i)] != objective.mesh_of[at(j)] || random.uniform() > 0.4) continue;
                const double gain = 0.5 * random.uniform();
                objective.ties[at(i)].push_back({j, gain});
                objective.ties[at(j)].push_back({i, gain});
            }
        }
    }

    [[nodiscard]] double value(const std::vector<int>& labels) const {
        double sum = 0.0;
        for (std::size_t i = 0; i < labels.size(); ++i) {
            sum += known.gain(labels[i], static_cast<Eigen::Index>(i));
            for (const PatchTie& tie : objective.ties[i])
                sum += labels[at(tie.other)] == labels[i] ? 0.5 * tie.gain : 0.0;
        }
        return sum;
    }

    [[nodiscard]] bool is_allowed(const std::vector<int>& labels) const {
        for (std::size_t i = 0; i < known.fixed.size(); ++i) {
            if (known.fixed[i] >= 0 && labels[i] != known.fixed[i]) return false;
        }
        return true;
    }

    /// The largest value of all labellings in two parts.
    [[nodiscard]] double best_value() const {
        const std::size_t count = objective.mesh_of.size();
        double best = -1.0;
        for (std::uint64_t bits = 0; bits < (std::uint64_t{1} << count); ++bits) {
            std::vector<int> labels;
            for (std::size_t i = 0; i < count; ++i) labels.push_back(static_cast<int>((bits >> i) & 1U));
            if (is_allowed(labels)) best = std::max(best, value(labels));
        }
        return best;
    }
};

TEST(PartExpansion, OfOneOfTwoPartsFindsTheBestOfAllLabellings) {
    const Comm comm(MPI_COMM_WORLD);
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const TiedPatches patches(2, 6, 2, seed);
        const std::vector<int> found =
            expand_parts(comm, patches.objective, patches.known, std::vector<int>(12, 0), 2);
        EXPECT_NEAR(patches.value(found), patches.best_value(), 1e-7) << seed;
    }
}

TEST(PartExpansion, LeavesFixedPatchesAndIsBestForTheOthers) {
    const Comm comm(MPI_COMM_WORLD);
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        TiedPatches patches(1, 10, 2, seed);
        patches.known.fixed.assign(10, -1);
        patches.known.fixed[2] = 0;
        patches.known.fixed[7] = 1;
        std::vector<int> start(10, 0);
        start[7] = 1;
        const std::vector<int> found = expand_parts(comm, patches.objective, patches.known, start, 2);
        EXPECT_TRUE(patches.is_allowed(found));
        EXPECT_NEAR(patches.value(found), patches.best_value(), 1e-7) << seed;
    }
}

TEST(PartExpansion, NeverLowersTheScoreThatItClimbs) {
    const Comm comm(MPI_COMM_WORLD);
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        TiedPatches patches(3, 12, 4, seed);
        std::vector<int> start;
        SeededStream random(seed);
        for (int i = 0; i < 36; ++i) start.push_back(static_cast<int>(random.uniform() * 4.0));
        const auto score = [&](const std::vector<int>& labels) { return patches.value(labels); };
        const std::vector<int> found =
            climb_by_expansion(comm, patches.objective, patches.known, start, 4, {score});
        EXPECT_GT(score(found), score(start));
        const Comm self(MPI_COMM_SELF);
        EXPECT_EQ(climb_by_expansion(self, patches.objective, patches.known, start, 4, {score}), found)
            << "on any number of ranks";
        const std::vector<int> again =
            climb_by_expansion(comm, patches.objective, patches.known, found, 4, {score});
        EXPECT_EQ(again, found) << "there is nothing more to gain";
        patches.objective.share.assign(36, 1.0 / 12.0);
        const std::vector<int> slowly =
            climb_by_expansion(comm, patches.objective, patches.known, start, 4, {score, falling_inertias});
        EXPECT_GT(score(slowly), score(start));
        EXPECT_EQ(climb_by_expansion(comm, patches.objective, patches.known, slowly, 4, {score}), slowly)
            << "the last rounds have no inertia";
    }
}

/// The derivative of the objective is what a patch of hardly any area gains, divided by its area.
TEST(PartExpansion, ASmallPatchGoesWhereItExplainsMost) {
    const Comm comm(MPI_COMM_WORLD);
    PartitionObjective objective;
    Eigen::MatrixXf deviations = (Eigen::MatrixXf(1, 5) << 1.0F, 1.0F, -1.0F, -1.0F, 1e-4F).finished();
    objective.deviations = PatchDeviations(deviations);
    objective.per_mesh = objective.pooled = Eigen::VectorXf::Ones(1);
    objective.ties.resize(5);
    objective.mesh_of.assign(5, 0);
    objective.area = {1.0, 1.0, 1.0, 1.0, 1e-4};
    objective.share = {0.25, 0.25, 0.25, 0.25, 0.0};
    objective.meshes = 1;
    EXPECT_EQ(expand_parts(comm, objective, {}, {0, 0, 1, 1, 1}, 2), (std::vector<int>{0, 0, 1, 1, 0}));
    objective.share.back() = 0.1;
    EXPECT_EQ(expand_parts(comm, objective, {}, {0, 0, 1, 1, 1}, 2, 1.0), (std::vector<int>{0, 0, 1, 1, 1}))
        << "with inertia it stays";
    EXPECT_EQ(expand_parts(comm, objective, {}, {0, 0, 1, 1, 1}, 2, 1e-9), (std::vector<int>{0, 0, 1, 1, 0}));
    objective.share.back() = 0.0;
    deviations(0, 4) = -1e-4F;
    objective.deviations = PatchDeviations(deviations);
    EXPECT_EQ(expand_parts(comm, objective, {}, {0, 0, 1, 1, 0}, 2), (std::vector<int>{0, 0, 1, 1, 1}));
}

}  // namespace
}  // namespace coseg
