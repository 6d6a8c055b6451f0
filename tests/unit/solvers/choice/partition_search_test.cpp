// The search for partitions: the sums over clusters and the moves of patches must say of every partition what
// the score says.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "solvers/choice/cluster_merging.hpp"
#include "solvers/choice/part_exchange.hpp"
#include "solvers/choice/patch_moves.hpp"
#include "src/base/index.hpp"
#include "src/base/seeded_random.hpp"

namespace coseg {
namespace {

/// Meshes of 24 patches in two over-segmentations, with random ties and two random descriptors.
struct RandomCollection {
    static constexpr int meshes = 4;
    static constexpr int patches_of_mesh = 24;
    static constexpr int patches = meshes * patches_of_mesh;
    std::vector<GlobalPatchNeighbors> neighbors;
    std::vector<GlobalPatchOverlap> overlaps;
    std::array<Eigen::MatrixXf, 2> histograms = {Eigen::MatrixXf(3, patches), Eigen::MatrixXf(2, patches)};
    std::vector<ChoiceDescriptor> descriptors;
    std::vector<int> mesh_of;
    std::vector<double> area;
    SparseRows links;
    ChoiceWeights weights{.crease = 1.5, .overlap = 20.0, .concavity = 0.0, .size = 6.0, .links = 9.0};

    explicit RandomCollection(std::uint64_t seed) {
        SeededStream random(seed);
        descriptors.push_back({patch_columns(histograms[0]), {.pooled = 7.0, .per_mesh = 11.0}});
        descriptors.push_back({patch_columns(histograms[1]), {.pooled = 5.0, .per_mesh = 0.0}});
        for (int i = 0; i < patches; ++i) {
            mesh_of.push_back(i / patches_of_mesh);
            area.push_back(0.2 + random.uniform());
            for (Eigen::MatrixXf& x : histograms) {
                for (Eigen::Index r = 0; r < x.rows(); ++r)
                    x(r, i) = static_cast<float>(random.uniform() + mesh_of.back());
            }
        }
        std::vector<SparseEntry> entries;
        for (int i = 0; i + patches_of_mesh < patches; ++i) {
            const int other = i + patches_of_mesh + (i % patches_of_mesh == 0 ? 1 : 0);
            const double weight = random.uniform();
            entries.push_back({i, other, weight});
            entries.push_back({other, i, weight});
        }
        links = rows_from_entries(patches, {0, patches}, entries);
        constexpr int half = patches_of_mesh / 2;
        for (int i = 0; i < patches; ++i) {
            if (i % half != half - 1) neighbors.push_back({i, i + 1, random.uniform(), random.uniform()});
            if (i % patches_of_mesh < half) {
                overlaps.push_back({i, i + half, random.uniform()});
                if (i % half != half - 1) overlaps.push_back({i, i + half + 1, random.uniform()});
            }
        }
    }

    [[nodiscard]] PartitionEvidence evidence() const {
        return {neighbors, overlaps, descriptors, mesh_of, area, links};
    }
    [[nodiscard]] double score(const std::vector<int>& labels, int parts) const {
        return partition_score(partition_terms(evidence(), labels, parts), weights, descriptors);
    }
};

std::vector<int> random_labels(int count, std::uint64_t seed) {
    SeededStream random(seed);
    std::vector<int> labels;
    for (int i = 0; i < RandomCollection::patches; ++i)
        labels.push_back(i < count ? i : static_cast<int>(random.uniform() * count));
    return labels;
}

std::vector<int> composed(const std::vector<int>& labels, const std::vector<int>& part_of) {
    std::vector<int> result;
    for (const int label : labels) result.push_back(part_of[at(label)]);
    return result;
}

double value_of(const ClusterSums& sums, const std::vector<int>& part_of, int parts) {
    double value = 0.0;
    for (int p = 0; p < parts; ++p) {
        std::vector<int> members;
        for (int c = 0; c < sums.count(); ++c) {
            if (part_of[at(c)] == p) members.push_back(c);
        }
        value += value_of_part(sums, members);
    }
    return value;
}

TEST(PartitionSearch, SumsOfClustersDifferFromTheScoreByAConstant) {
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
        const RandomCollection c(seed);
        const std::vector<int> clusters = random_labels(7, seed);
        const ClusterSums sums = cluster_sums(partition_objective(c.evidence(), c.weights), clusters, 7);
        const std::vector<int> first = {0, 1, 2, 0, 1, 2, 0};
        const std::vector<int> second = {2, 2, 1, 0, 0, 1, 2};
        const double by_sums = value_of(sums, first, 3) - value_of(sums, second, 3);
        const double by_score =
            c.score(composed(clusters, first), 3) - c.score(composed(clusters, second), 3);
        EXPECT_NEAR(by_sums, by_score, 1e-5);
    }
}

TEST(PartitionSearch, AUnionHasTheValueOfItsMembersTogether) {
    const RandomCollection c(3);
    const ClusterSums sums =
        cluster_sums(partition_objective(c.evidence(), c.weights), random_labels(6, 3), 6);
    ClusterSums united = sums;
    unite(united, 1, 3);  // 5 becomes 3
    ASSERT_EQ(united.count(), 5);
    EXPECT_NEAR(value_of_part(united, std::vector<int>{1}), value_of_part(sums, std::vector<int>{1, 3}),
                1e-9);
    EXPECT_NEAR(value_of_part(united, std::vector<int>{3, 1}), value_of_part(sums, std::vector<int>{5, 1, 3}),
                1e-9);
    unite(united, 2, 4);  // the last one itself
    EXPECT_NEAR(value_of_part(united, std::vector<int>{2}), value_of_part(sums, std::vector<int>{2, 4}),
                1e-9);
}

TEST(PartitionSearch, NoSingleMoveOfAClusterImprovesTheMergedParts) {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        const RandomCollection c(seed);
        const ClusterSums sums =
            cluster_sums(partition_objective(c.evidence(), c.weights), random_labels(9, seed), 9);
        for (const std::vector<int>& part_of : merge_clusters(sums, 3)) {
            EXPECT_EQ(*std::max_element(part_of.begin(), part_of.end()), 2);
            const double value = value_of(sums, part_of, 3);
            for (std::size_t k = 0; k < part_of.size(); ++k) {
                for (int p = 0; p < 3; ++p) {
                    std::vector<int> other = part_of;
                    other[k] = p;
                    if (std::count(other.begin(), other.end(), part_of[k]) == 0) continue;
                    EXPECT_LE(value_of(sums, other, 3), value + 1e-8) << "seed " << seed;
                }
            }
        }
    }
}

TEST(PartitionSearch, ClustersOfTrueSegmentsAreMergedIntoThem) {
    RandomCollection c(1);
    // Each mesh's patches come in three runs of four, in both over-segmentations, and the first descriptor
    // tells the runs apart.
    std::vector<int> truth;
    std::vector<int> clusters;
    for (int i = 0; i < RandomCollection::patches; ++i) {
        truth.push_back(i % 12 / 4);
        clusters.push_back(3 * (i % 3) + truth.back());
        for (Eigen::Index r = 0; r < 3; ++r) c.histograms[0](r, i) = r == truth.back() ? 1.0 : 0.0;
    }
    const std::vector<int> part_of =
        merge_clusters(cluster_sums(partition_objective(c.evidence(), c.weights), clusters, 9), 3).front();
    for (std::size_t k = 0; k < 9; ++k) EXPECT_EQ(part_of[k], part_of[k % 3]) << k;
    EXPECT_NE(part_of[0], part_of[1]);
    EXPECT_NE(part_of[0], part_of[2]);
    EXPECT_NE(part_of[1], part_of[2]);
}

TEST(PartitionSearch, APartOfASingleMeshIsGivenUpForOneThatAllMeshesHave) {
    RandomCollection c(1);
    // Runs of four patches as above. One patch of one mesh is like nothing else, the second run differs from
    // the third by little.
    std::vector<int> clusters;
    for (int i = 0; i < RandomCollection::patches; ++i) {
        const int run = i % 12 / 4;
        clusters.push_back(i == 30 ? 3 : run);
        for (Eigen::Index r = 0; r < 3; ++r) {
            const float of_run = r == 0 && run == 0 ? 1.0F : (r == 1 && run == 1 ? 0.05F : 0.0F);
            c.histograms[0](r, i) = static_cast<float>(i == 30 && r == 2 ? 9.0 : of_run);
        }
    }
    const ClusterSums sums = cluster_sums(partition_objective(c.evidence(), c.weights), clusters, 4);
    EXPECT_GT(value_of(sums, {0, 1, 1, 2}, 3), value_of(sums, {0, 1, 2, 2}, 3) + 1.0)
        << "by its value alone the single patch would be a part";
    for (const std::vector<int>& part_of : merge_clusters(sums, 3)) {
        EXPECT_EQ(*std::max_element(part_of.begin(), part_of.end()), 2);
        EXPECT_GT(std::count(part_of.begin(), part_of.end(), part_of[3]), 1) << "it is no part of its own";
    }
}

TEST(PartitionSearch, AsManyClustersAsPartsStayAsTheyAre) {
    const RandomCollection c(2);
    const ClusterSums sums =
        cluster_sums(partition_objective(c.evidence(), c.weights), random_labels(3, 2), 3);
    EXPECT_EQ(merge_clusters(sums, 3).front(), (std::vector<int>{0, 1, 2}));
    EXPECT_EQ(merge_clusters(sums, 5).front(), (std::vector<int>{0, 1, 2}));
}

TEST(PartitionSearch, MovesOfPatchesRaiseTheScoreAndKeepEveryPart) {
    int done = 0;
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        const RandomCollection c(seed);
        const PartitionObjective objective = partition_objective(c.evidence(), c.weights);
        std::vector<int> labels = random_labels(3, seed);
        double score = c.score(labels, 3);
        bool is_done = false;
        for (int round = 0; round < 200 && !is_done; ++round) {
            const MovedPatches step = move_patches(objective, labels, 3, 1);
            int different = 0;
            for (std::size_t i = 0; i < labels.size(); ++i) different += step.labels[i] != labels[i] ? 1 : 0;
            EXPECT_EQ(step.moved, different);
            EXPECT_LE(step.moved, RandomCollection::meshes);
            is_done = step.moved == 0;
            labels = step.labels;
            for (int p = 0; p < 3; ++p) EXPECT_GT(std::count(labels.begin(), labels.end(), p), 0);
        }
        EXPECT_GT(c.score(labels, 3), score + 1.0) << "seed " << seed;
        // Two meshes whose moves need each other to stay may go back and forth together for ever.
        if (!is_done) continue;
        ++done;
        // With the other meshes at rest, no move of one patch is better than none.
        score = c.score(labels, 3);
        for (int i = 0; i < RandomCollection::patches; i += 7) {
            for (const PatchTie& tie : objective.ties[at(i)]) {
                std::vector<int> other = labels;
                other[at(i)] = labels[at(tie.other)];
                EXPECT_LE(c.score(other, 3), score + 1e-4) << "seed " << seed << " patch " << i;
            }
        }
    }
    EXPECT_GE(done, 8);
}

TEST(PartitionSearch, DescriptorsOfNoSpreadAndMeshesWithoutOverlapsAddNothing) {
    RandomCollection c(4);
    c.overlaps.clear();
    for (Eigen::MatrixXf& x : c.histograms) x.setConstant(2.0F);
    const PartitionObjective objective = partition_objective(c.evidence(), c.weights);
    EXPECT_TRUE(objective.deviations.matrix().isZero());
    const std::vector<int> clusters = random_labels(5, 4);
    const ClusterSums sums = cluster_sums(objective, clusters, 5);
    const std::vector<int> first = {0, 1, 0, 1, 0};
    const std::vector<int> second = {0, 0, 0, 1, 1};
    EXPECT_NEAR(value_of(sums, first, 2) - value_of(sums, second, 2),
                c.score(composed(clusters, first), 2) - c.score(composed(clusters, second), 2), 1e-9);
}

/// The labels with the parts of one mesh named otherwise.
std::vector<int> renamed_in(const RandomCollection& c, std::vector<int> labels, int mesh,
                            const std::vector<int>& part_of) {
    for (std::size_t i = 0; i < labels.size(); ++i) {
        if (c.mesh_of[i] == mesh) labels[i] = part_of[at(labels[i])];
    }
    return labels;
}

TEST(PartitionSearch, AfterExchangesNoOtherNamesOfAMeshsPartsHaveABetterScore) {
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
        const RandomCollection c(seed);
        const std::vector<int> before = random_labels(3, seed);
        const std::vector<int> after =
            exchange_parts(partition_objective(c.evidence(), c.weights), before, 3);
        EXPECT_GT(c.score(after, 3), c.score(before, 3));
        for (int mesh = 0; mesh < RandomCollection::meshes; ++mesh) {
            std::vector<int> part_of = {0, 1, 2};
            do {
                EXPECT_LE(c.score(renamed_in(c, after, mesh, part_of), 3), c.score(after, 3) + 1e-5);
            } while (std::next_permutation(part_of.begin(), part_of.end()));
        }
    }
}

TEST(PartitionSearch, AnExchangeMendsTheMeshWhosePartsAreSwapped) {
    RandomCollection c(1);
    const std::vector<int> right = random_labels(3, 8);
    for (int i = 0; i < RandomCollection::patches; ++i)
        c.histograms[0].col(i) = 4.0F * Eigen::Vector3f::Unit(right[at(i)]);
    const std::vector<int> wrong = renamed_in(c, right, 2, {1, 2, 0});
    EXPECT_EQ(exchange_parts(partition_objective(c.evidence(), c.weights), wrong, 3), right);
}

}  // namespace
}  // namespace coseg
