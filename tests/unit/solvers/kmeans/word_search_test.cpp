#include "solvers/kmeans/word_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <set>

#include "solvers/kmeans/word_seeds.hpp"
#include "src/base/seeded_random.hpp"

namespace coseg {
namespace {

Eigen::MatrixXf noise(Eigen::Index rows, Eigen::Index cols, std::uint64_t seed) {
    SeededStream random(seed);
    Eigen::MatrixXf result(rows, cols);
    for (float& entry : result.reshaped()) entry = static_cast<float>(random.uniform());
    return result;
}

TEST(WordSearch, FindsTheNearestAndBoundsTheOthers) {
    for (const Eigen::Index dims : {1, 3, 30}) {
        const Eigen::MatrixXf points = noise(dims, 300, 1);
        const Eigen::MatrixXf words = noise(dims, 17, 2);
        std::vector<int> columns;
        for (int i = 299; i >= 0; i -= 2) columns.push_back(i);
        std::vector<NearestWord> nearest;
        WordSearch(words).search(points, columns, nearest);
        for (std::size_t k = 0; k < columns.size(); ++k) {
            Eigen::VectorXd distance(17);
            for (int w = 0; w < 17; ++w) {
                distance[w] = (points.col(columns[k]).cast<double>() - words.col(w).cast<double>()).norm();
                ASSERT_NEAR(WordSearch(words).distance(points, columns[k], w), distance[w], 1e-6);
            }
            EXPECT_NEAR(distance[nearest[k].word], distance.minCoeff(), 1e-5);
            EXPECT_NEAR(nearest[k].distance, distance.minCoeff(), 2e-3);
            distance[nearest[k].word] = std::numeric_limits<double>::infinity();
            EXPECT_LE(nearest[k].second_distance, distance.minCoeff());
            EXPECT_GE(nearest[k].second_distance, distance.minCoeff() - 0.02);
        }
    }
}

TEST(WordSearch, OneWordHasNoSecond) {
    std::vector<NearestWord> nearest;
    WordSearch(noise(4, 1, 1)).search(noise(4, 5, 2), std::vector<int>{0, 4}, nearest);
    ASSERT_EQ(nearest.size(), 2U);
    EXPECT_EQ(nearest[1].word, 0);
    EXPECT_EQ(nearest[1].second_distance, std::numeric_limits<float>::infinity());
}

TEST(WordSeeds, AreDistinctPointsAndAsManyAsThereAre) {
    const Eigen::MatrixXf distinct = noise(7, 5, 3);
    Eigen::MatrixXf points(2100, 5);
    for (Eigen::Index i = 0; i < points.rows(); ++i) points.row(i) = distinct.row(i % 7);
    for (const int words : {1, 3, 7, 50}) {
        const Eigen::MatrixXf seeds = word_seeds(points, words, 11);
        ASSERT_EQ(seeds.cols(), std::min(words, 7));
        std::set<std::vector<float>> found;
        for (Eigen::Index w = 0; w < seeds.cols(); ++w)
            found.emplace(seeds.col(w).begin(), seeds.col(w).end());
        EXPECT_EQ(found.size(), static_cast<std::size_t>(seeds.cols()));
        for (Eigen::Index w = 0; w < seeds.cols(); ++w) {
            EXPECT_EQ((distinct.rowwise() - seeds.col(w).transpose()).rowwise().norm().minCoeff(), 0.0F);
        }
    }
    EXPECT_EQ(word_seeds(Eigen::MatrixXf(0, 5), 3, 1).cols(), 0);
}

TEST(WordSeeds, FarGroupsEachGetOne) {
    Eigen::MatrixXf points = noise(400, 6, 4) * 0.01F;
    for (Eigen::Index i = 0; i < points.rows(); ++i) points(i, i % 4) += 10.0F;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const Eigen::MatrixXf seeds = word_seeds(points, 4, seed);
        std::set<Eigen::Index> groups;
        for (Eigen::Index w = 0; w < 4; ++w) {
            Eigen::Index group = 0;
            seeds.col(w).maxCoeff(&group);
            groups.insert(group);
        }
        EXPECT_EQ(groups.size(), 4U);
    }
}

}  // namespace
}  // namespace coseg
