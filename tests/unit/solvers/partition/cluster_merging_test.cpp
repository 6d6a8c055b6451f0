#include "solvers/partition/cluster_merging.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "src/base/seeded_random.hpp"

namespace coseg {
namespace {

ClusterLinks random_links(int clusters, std::uint64_t seed) {
    ClusterLinks c{Eigen::MatrixXd::Zero(clusters, clusters), Eigen::VectorXd::Zero(clusters)};
    SeededStream random(seed);
    for (int a = 0; a < clusters; ++a) {
        for (int b = a; b < clusters; ++b)
            c.links(a, b) = c.links(b, a) = random.uniform() + (a == b ? 2.0 : 0.0);
    }
    c.volume = c.links.rowwise().sum();
    return c;
}

/// The normalised cut of the clusters united as `part_of_cluster` says, by definition.
double normalized_cut(const ClusterLinks& c, const std::vector<int>& part_of_cluster, int parts) {
    double value = 0.0;
    for (int p = 0; p < parts; ++p) {
        double inside = 0.0;
        double volume = 0.0;
        for (int a = 0; a < c.volume.size(); ++a) {
            if (part_of_cluster[static_cast<std::size_t>(a)] != p) continue;
            volume += c.volume(a);
            for (int b = 0; b < c.volume.size(); ++b) {
                if (part_of_cluster[static_cast<std::size_t>(b)] == p) inside += c.links(a, b);
            }
        }
        if (volume > 0.0) value += (volume - inside) / volume;
    }
    return value;
}

TEST(ClusterMerging, OneMergerIsTheBestOfAllPairs) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        constexpr int clusters = 6;
        const ClusterLinks c = random_links(clusters, seed);
        const std::vector<int> merged =
            merge_clusters(c, std::vector<int>(clusters, 1), clusters - 1, MergeRule::normalized_cut);
        double best = 1e9;
        for (int a = 0; a < clusters; ++a) {
            for (int b = a + 1; b < clusters; ++b) {
                std::vector<int> trial(clusters);
                for (int k = 0; k < clusters; ++k)
                    trial[static_cast<std::size_t>(k)] = k == b ? a : k - (k > b ? 1 : 0);
                best = std::min(best, normalized_cut(c, trial, clusters - 1));
            }
        }
        EXPECT_NEAR(normalized_cut(c, merged, clusters - 1), best, 1e-12) << "seed " << seed;
    }
}

TEST(ClusterMerging, PutsHalvesTogether) {
    // Clusters 0-3, 1-4, 2-5 are halves of one part each: strong between them, weak to all others.
    ClusterLinks c{Eigen::MatrixXd::Constant(6, 6, 0.05), Eigen::VectorXd::Zero(6)};
    for (int a = 0; a < 6; ++a) c.links(a, a) = 2.0;
    for (int a = 0; a < 3; ++a) c.links(a, a + 3) = c.links(a + 3, a) = 1.5;
    c.volume = c.links.rowwise().sum();
    for (const MergeRule rule : {MergeRule::normalized_cut, MergeRule::linkage})
        EXPECT_EQ(merge_clusters(c, std::vector<int>(6, 4), 3, rule), (std::vector<int>{0, 1, 2, 0, 1, 2}));
}

TEST(ClusterMerging, EmptyClustersDoNotCountAndTiesGoToTheLowest) {
    ClusterLinks c{Eigen::MatrixXd::Constant(5, 5, 1.0), Eigen::VectorXd::Constant(5, 5.0)};
    for (const MergeRule rule : {MergeRule::normalized_cut, MergeRule::linkage}) {
        EXPECT_EQ(merge_clusters(c, {3, 0, 2, 2, 1}, 3, rule), (std::vector<int>{0, -1, 0, 1, 2}));
        EXPECT_EQ(merge_clusters(c, {3, 0, 0, 0, 1}, 3, rule), (std::vector<int>{0, -1, -1, -1, 1}));
    }
}

TEST(ClusterMerging, LinkageSparesASmallLooseClusterThatTheNormalisedCutGivesUp) {
    // 0 and 1 are halves of a part, 2 is a small part beside 3.
    ClusterLinks c{Eigen::MatrixXd::Zero(4, 4), Eigen::VectorXd::Zero(4)};
    c.links.diagonal() << 100.0, 100.0, 6.0, 100.0;
    c.links(0, 1) = c.links(1, 0) = 10.0;
    c.links(2, 3) = c.links(3, 2) = 2.5;
    c.volume = c.links.rowwise().sum();
    const std::vector<int> sizes(4, 1);
    EXPECT_EQ(merge_clusters(c, sizes, 3, MergeRule::normalized_cut), (std::vector<int>{0, 1, 2, 2}));
    EXPECT_EQ(merge_clusters(c, sizes, 3, MergeRule::linkage), (std::vector<int>{0, 0, 1, 2}));
}

TEST(ClusterMerging, LinkageJoinsTheLargestShareOfTheMeanVolume) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        constexpr int clusters = 6;
        const ClusterLinks c = random_links(clusters, seed);
        const std::vector<int> merged =
            merge_clusters(c, std::vector<int>(clusters, 1), clusters - 1, MergeRule::linkage);
        double largest = 0.0;
        double joined = 0.0;
        for (int a = 0; a < clusters; ++a) {
            for (int b = a + 1; b < clusters; ++b) {
                const double share = c.links(a, b) / std::sqrt(c.volume(a) * c.volume(b));
                largest = std::max(largest, share);
                if (merged[static_cast<std::size_t>(a)] == merged[static_cast<std::size_t>(b)])
                    joined = share;
            }
        }
        EXPECT_DOUBLE_EQ(joined, largest) << "seed " << seed;
    }
}

TEST(ClusterMerging, SharesOfAMeshSumToOne) {
    const Eigen::MatrixXd shares = area_shares({0, 1, 1, 2}, 3, {1.0, 3.0, 5.0, 15.0}, {0, 0, 1, 1});
    Eigen::MatrixXd expected(3, 2);
    expected << 0.25, 0.0, 0.75, 0.25, 0.0, 0.75;
    EXPECT_EQ(shares, expected);
}

}  // namespace
}  // namespace coseg
