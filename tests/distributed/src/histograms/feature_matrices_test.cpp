#include "src/histograms/feature_matrices.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "src/parallel/block_range.hpp"
#include "tests/support/errors.hpp"

namespace coseg {
namespace {

constexpr Eigen::Index sizes[3] = {4, 1, 7};
constexpr Eigen::Index columns = 61;

double entry(Eigen::Index h, Eigen::Index k, Eigen::Index i) {
    return static_cast<double>(10000 * i + 100 * h + k);
}

/// Runs of 5 columns, dealt over the ranks.
std::vector<FilledColumns> deal(const Comm& comm) {
    std::vector<FilledColumns> runs;
    for (Eigen::Index begin = 0; begin < columns; begin += 5)
        runs.push_back({begin, std::min(begin + 5, columns), static_cast<int>(begin * 7 % comm.size())});
    return runs;
}

void fill_own(const Comm& comm, FeatureMatrices& features) {
    for (const FilledColumns& run : deal(comm)) {
        if (run.rank != comm.rank()) continue;
        for (std::size_t h = 0; h < 3; ++h) {
            FeatureMatrices::Block block = features.fill(h);
            for (Eigen::Index i = run.begin; i < run.end; ++i) {
                for (Eigen::Index k = 0; k < sizes[h]; ++k)
                    block(k, i) = entry(static_cast<Eigen::Index>(h), k, i);
            }
        }
    }
}

void expect_filled(const FeatureMatrices& features, double factor = 1.0) {
    ASSERT_EQ(features.size(), 3U);
    ASSERT_EQ(features.columns(), columns);
    ASSERT_EQ(features.dimension(), 12);
    for (std::size_t h = 0; h < 3; ++h) {
        const FeatureMatrices::ConstBlock x = features[h];
        ASSERT_EQ(x.rows(), sizes[h]);
        for (Eigen::Index i = 0; i < columns; ++i) {
            for (Eigen::Index k = 0; k < sizes[h]; ++k)
                ASSERT_EQ(x(k, i), factor * entry(static_cast<Eigen::Index>(h), k, i));
        }
    }
}

/// On one node, on nodes of every other rank, of pairs of ranks, of one rank and the rest, of one rank each.
std::vector<int> nodes_of(const Comm& comm) {
    return {0, comm.rank() % 2, comm.rank() / 2, comm.rank() == 0 ? 1 : 0, comm.rank()};
}

TEST(FeatureMatrices, ColumnsOfAllRanksReachAllNodes) {
    const Comm world(MPI_COMM_WORLD);
    for (const int node : nodes_of(world)) {
        FeatureMatrices features(NodeRanks(world, node), {sizes[0], sizes[1], sizes[2]}, columns);
        fill_own(world, features);
        features.share(deal(world));
        expect_filled(features);
        EXPECT_FALSE(features.fell_back());
        features.for_each_column([&](Eigen::Index, double* column) {
            for (Eigen::Index k = 0; k < 12; ++k) column[k] *= 2.0;
        });
        expect_filled(features, 2.0);
    }
}

TEST(FeatureMatrices, PartsAreCopiesAndHandlesAreNot) {
    const Comm world(MPI_COMM_WORLD);
    FeatureMatrices features(world, {sizes[0], sizes[1], sizes[2]}, columns);
    fill_own(world, features);
    features.share(deal(world));
    const FeatureMatrices last = features.only(world, 2);
    ASSERT_EQ(last.size(), 1U);
    EXPECT_EQ(Eigen::MatrixXd(last[0]), Eigen::MatrixXd(features[2]));
    const std::vector<int> order = {60, 3, 3, 0};
    const FeatureMatrices part = features.chosen(world, order);
    ASSERT_EQ(part.columns(), 4);
    for (Eigen::Index i = 0; i < 4; ++i)
        EXPECT_EQ(part[1].col(i), features[1].col(order[static_cast<std::size_t>(i)]));
    const FeatureMatrices one = features.joined();
    ASSERT_EQ(one.size(), 1U);
    EXPECT_EQ(one[0].rows(), 12);
    EXPECT_EQ(one.data(), features.data());
    const FeatureMatrices handle = features;
    EXPECT_EQ(handle.data(), features.data());
    EXPECT_NE(last.data(), features.data());
}

TEST(FeatureMatrices, OfTheRootReachAll) {
    const Comm world(MPI_COMM_WORLD);
    std::vector<Eigen::MatrixXd> of_root;
    if (world.is_root()) {
        for (Eigen::Index h = 0; h < 3; ++h) {
            Eigen::MatrixXd x(sizes[h], columns);
            for (Eigen::Index i = 0; i < columns; ++i) {
                for (Eigen::Index k = 0; k < sizes[h]; ++k) x(k, i) = entry(h, k, i);
            }
            of_root.push_back(x);
        }
    }
    expect_filled(share_matrices(world, of_root));
    if (world.is_root()) {
        expect_filled(FeatureMatrices(of_root));
        of_root[1].conservativeResize(1, columns - 1);
    }
    const test::Caught error = test::error_of([&] { share_matrices(world, of_root); });
    EXPECT_EQ(error.code, ExitCode::input);
    EXPECT_NE(error.sentence.find("feature 2 has 60 columns but feature 1 has 61"), std::string::npos);
    EXPECT_TRUE(share_matrices(world, {}).empty());
}

}  // namespace
}  // namespace coseg
