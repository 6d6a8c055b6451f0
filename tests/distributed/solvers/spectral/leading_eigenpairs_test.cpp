#include "solvers/spectral/leading_eigenpairs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <span>

#include "solvers/spectral/spectral_embedding.hpp"
#include "src/base/seeded_random.hpp"
#include "src/parallel/block_range.hpp"
#include "tests/support/graphs.hpp"

namespace coseg {
namespace {

using testing_graphs::graph;
using testing_graphs::owned_rows;

constexpr int nodes = 140;  // not a multiple of a tile

constexpr int path_nodes = 70;  // three tiles: of four ranks one owns nothing

Eigen::VectorXd local_start(const Comm& comm, std::int64_t size, int trial) {
    const BlockRange rows = block_range(size, comm.size(), comm.rank(), row_tile);
    Eigen::VectorXd start(rows.size());
    for (auto i = rows.begin; i < rows.end; ++i) {
        const auto row = static_cast<std::uint64_t>(i);
        start(i - rows.begin) = uniform_of(hash_words({static_cast<std::uint64_t>(trial), row})) - 0.5;
    }
    return start;
}

EigenPairs pairs_of(const Comm& comm, const SparseRows& complete, int wanted, const EigenPairs& known = {}) {
    const RowProduct product(comm, owned_rows(comm, complete));
    return leading_eigenpairs(comm, product, known, local_start(comm, complete.size, 3),
                              {wanted, 1e-10, 2000});
}

std::vector<double> gathered(const Comm& comm, const EigenPairs& pairs, Eigen::Index k) {
    const Eigen::VectorXd column = pairs.vectors.col(k);
    return all_gather(comm, std::span<const double>(column.data(), static_cast<std::size_t>(column.size())));
}

/// A path whose matrix is symmetric with 2 cos(pi k / (n + 1)) as eigenvalues and sines as eigenvectors.
TEST(LeadingEigenpairs, OfAPathAreCosinesAndSines) {
    const Comm comm(MPI_COMM_WORLD);
    const EigenPairs pairs = pairs_of(comm, graph(path_nodes, testing_graphs::path_edges(path_nodes)), 5);
    for (int k = 0; k < 5; ++k) {
        const double angle = std::numbers::pi * (k + 1) / (path_nodes + 1);
        EXPECT_NEAR(pairs.values[static_cast<std::size_t>(k)], 2.0 * std::cos(angle), 1e-12);
        EXPECT_LE(pairs.residuals[static_cast<std::size_t>(k)], 1e-10);
        const std::vector<double> vector = gathered(comm, pairs, k);
        double product = 0.0;
        for (int i = 0; i < path_nodes; ++i)
            product += vector[static_cast<std::size_t>(i)] * std::sin(angle * (i + 1));
        EXPECT_NEAR(std::abs(product), std::sqrt((path_nodes + 1) / 2.0), 1e-9);
    }
}

TEST(LeadingEigenpairs, OnTheComplementOfKnownOnesAreTheNext) {
    const Comm comm(MPI_COMM_WORLD);
    const SparseRows path = graph(path_nodes, testing_graphs::path_edges(path_nodes));
    const EigenPairs first = pairs_of(comm, path, 2);
    const EigenPairs next = pairs_of(comm, path, 2, first);
    for (int k = 0; k < 2; ++k) {
        EXPECT_NEAR(next.values[static_cast<std::size_t>(k)],
                    2.0 * std::cos(std::numbers::pi * (k + 3) / (path_nodes + 1)), 1e-12);
    }
}

TEST(LeadingEigenpairs, HaveTheSameBytesAsOnOneRank) {
    const Comm comm(MPI_COMM_WORLD);
    const Comm self(MPI_COMM_SELF);
    const SparseRows blocks = graph(nodes, testing_graphs::block_edges(10, nodes / 10, 0.1, 4));
    const EigenPairs shared = pairs_of(comm, blocks, 20);
    const EigenPairs alone = pairs_of(self, blocks, 20);
    EXPECT_EQ(shared.values, alone.values);
    EXPECT_EQ(shared.residuals, alone.residuals);
    for (Eigen::Index k = 0; k < 20; ++k) EXPECT_EQ(gathered(comm, shared, k), gathered(self, alone, k));
}

TEST(LeadingEigenpairs, GiveAnEmbeddingOfTheSameBytesAsOnOneRank) {
    const Comm comm(MPI_COMM_WORLD);
    const Comm self(MPI_COMM_SELF);
    const SparseRows blocks = graph(nodes, testing_graphs::block_edges(10, nodes / 10, 0.1, 4));
    std::vector<int> mesh_of;
    for (int i = 0; i < nodes; ++i) mesh_of.push_back(i / 23);
    SpectralOptions options;
    options.mesh_balance = 0.3;
    const SpectralEmbedding shared =
        spectral_embedding(comm, owned_rows(comm, blocks), 4, 12, options, mesh_of);
    const SpectralEmbedding alone = spectral_embedding(self, blocks, 4, 12, options, mesh_of);
    EXPECT_EQ(shared.rows, alone.rows);
    EXPECT_EQ(shared.eigenvalues, alone.eigenvalues);
    EXPECT_EQ(shared.residuals, alone.residuals);
    EXPECT_TRUE((shared.coordinates.array() == alone.coordinates.array()).all());
}

TEST(LeadingEigenpairs, SortedKeepTheOrderOfEqualValues) {
    EigenPairs pairs;
    for (const double value : {1.0, 3.0, 3.0}) {
        const auto number = static_cast<double>(pairs.values.size());
        pairs.append(value, number, Eigen::VectorXd::Constant(2, number));
    }
    const EigenPairs sorted = sorted_descending(pairs);
    EXPECT_EQ(sorted.values, (std::vector<double>{3.0, 3.0, 1.0}));
    EXPECT_EQ(sorted.residuals, (std::vector<double>{1.0, 2.0, 0.0}));
    EXPECT_EQ(sorted.vectors.row(0), (Eigen::RowVector3d(1.0, 2.0, 0.0)));
}

}  // namespace
}  // namespace coseg
