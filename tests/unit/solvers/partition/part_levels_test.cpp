#include "solvers/partition/part_levels.hpp"

#include <gtest/gtest.h>

#include "src/base/index.hpp"

namespace coseg {
namespace {

/// Clusters without descriptors in one mesh: what they lose when they stay apart are their ties.
ClusterSums tied_clusters(const Eigen::MatrixXd& ties, const Eigen::VectorXd& area) {
    ClusterSums sums;
    sums.per_mesh = {Eigen::MatrixXd::Zero(ties.rows(), ties.rows())};
    sums.pooled = sums.per_mesh.front();
    sums.ties = ties;
    sums.area = sums.share = area;
    return sums;
}

/// Parts {0, 1, 2}, {3, 4} and {5}; 1 and 2 are tied most, 2 and 3 more, but these lie in two parts.
PartTree tree(int finest) {
    Eigen::MatrixXd ties = Eigen::MatrixXd::Zero(6, 6);
    const auto tie = [&](int a, int b, double gain) { ties(a, b) = ties(b, a) = gain; };
    tie(1, 2, 5.0);
    tie(2, 3, 9.0);
    tie(0, 1, 2.0);
    tie(3, 4, 3.0);
    tie(4, 5, 1.0);
    const Eigen::VectorXd area = (Eigen::VectorXd(6) << 1, 2, 4, 1, 3, 1).finished();
    return part_tree(tied_clusters(ties, area), {0, 0, 0, 1, 1, 2}, finest);
}

TEST(PartTree, UnitesThePairThatLosesLeastFirstInsideThePartsAndThenBetweenThem) {
    const PartTree made = tree(6);
    ASSERT_EQ(made.finest(), 6);
    // Part 0 is led by cluster 2, its largest, part 1 by cluster 4. From the back, 0 was split off last.
    EXPECT_EQ(made.piece_of_patch, (std::vector<int>{3, 5, 0, 4, 1, 2}));
    const std::vector<PieceUnion> expected = {{0, 5, -10.0}, {1, 4, -6.0}, {0, 3, -4.0}, {0, 1, -18.0}};
    EXPECT_EQ(made.unions, expected);
}

TEST(PartTree, LevelsAreNestedAndThatOfThePartsIsThePartsThemselves) {
    const PartTree made = tree(6);
    EXPECT_EQ(labels_at_level(made, 6), (std::vector<int>{0, 1, 2, 3, 4, 5}));
    EXPECT_EQ(labels_at_level(made, 5), (std::vector<int>{0, 1, 2, 3, 4, 0}));
    EXPECT_EQ(labels_at_level(made, 4), (std::vector<int>{0, 1, 2, 3, 1, 0}));
    EXPECT_EQ(labels_at_level(made, 3), (std::vector<int>{0, 1, 2, 0, 1, 0}));
    EXPECT_EQ(labels_at_level(made, 2), (std::vector<int>{0, 0, 1, 0, 0, 0})) << "numbers close ranks";
}

TEST(PartTree, FollowsTheLevelsThatAreGivenWhateverTheUnionsLose) {
    Eigen::MatrixXd ties = Eigen::MatrixXd::Zero(4, 4);
    ties(0, 1) = ties(1, 0) = 5.0;
    ties(2, 3) = ties(3, 2) = 7.0;
    // Part 0 is {0, 1, 2}, from which the finer level cuts 1 out. Of its two halves {0, 2} is the larger.
    const PartitionsByNumber levels = {{0, 0, 0, 1}, {0, 2, 0, 1}};
    const PartTree made =
        part_tree(tied_clusters(ties, Eigen::Vector4d(1, 1, 1, 1)), {0, 0, 0, 1}, 4, levels);
    ASSERT_EQ(made.finest(), 4);
    const auto same_at = [&](int count, int a, int b) {
        const std::vector<int> label = labels_at_level(made, count);
        return label[at(made.piece_of_patch[at(a)])] == label[at(made.piece_of_patch[at(b)])];
    };
    EXPECT_TRUE(same_at(3, 0, 2));
    EXPECT_FALSE(same_at(3, 0, 1)) << "although they are tied";
    EXPECT_TRUE(same_at(2, 0, 1));
    EXPECT_FALSE(same_at(2, 2, 3)) << "the level of the parts is the parts";
    EXPECT_EQ(made.unions.back().loss, -10.0) << "what the union of {0, 2} and {1} gains by its tie";
}

TEST(PartTree, StartsFromTheFinestLevelThatIsAskedFor) {
    const PartTree made = tree(4);
    EXPECT_EQ(made.finest(), 4);
    EXPECT_EQ(made.piece_of_patch, (std::vector<int>{3, 0, 0, 1, 1, 2}));
    EXPECT_EQ(tree(2).finest(), 3) << "not coarser than the parts";
}

}  // namespace
}  // namespace coseg
