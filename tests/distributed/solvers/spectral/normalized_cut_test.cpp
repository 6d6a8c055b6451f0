#include "solvers/spectral/normalized_cut.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <string>

#include "solvers/affinity/graph_components.hpp"
#include "tests/support/graphs.hpp"

namespace coseg {
namespace {

using testing_graphs::Edge;
using testing_graphs::graph;
using testing_graphs::owned_rows;
using testing_graphs::same_partition;

SpectralEmbedding embed(const Comm& comm, const SparseRows& complete, int parts, int count,
                        double offset = 0.0) {
    SpectralOptions options;
    options.offset = offset;
    return spectral_embedding(comm, owned_rows(comm, complete), parts, count, options);
}

/// Residual of the generalised problem S y = value D y, which back-multiplied eigenvectors solve.
double residual(const SparseRows& s, const SpectralEmbedding& e, double offset) {
    double worst = 0.0;
    for (Eigen::Index k = 0; k < e.coordinates.cols(); ++k) {
        Eigen::VectorXd y = Eigen::VectorXd::Zero(s.size);
        for (std::size_t r = 0; r < e.rows.size(); ++r)
            y(e.rows[r]) = e.coordinates(static_cast<Eigen::Index>(r), k);
        for (std::size_t r = 0; r < e.rows.size(); ++r) {
            const auto i = static_cast<std::size_t>(e.rows[r]);
            double sum = offset * y(e.rows[r]);
            for (auto entry = static_cast<std::size_t>(s.offsets[i]);
                 entry < static_cast<std::size_t>(s.offsets[i + 1]); ++entry) {
                sum += s.values[entry] * y(s.columns[entry]);
            }
            const double expected = e.eigenvalues[static_cast<std::size_t>(k)] * e.degrees[r] * y(e.rows[r]);
            worst = std::max(worst, std::abs(sum - expected));
        }
    }
    return worst;
}

class KnownSpectrum : public testing::TestWithParam<int> {};

TEST_P(KnownSpectrum, OfAPath) {
    // Random walk on a path of n nodes: cos(pi k / (n - 1)).
    const Comm comm(MPI_COMM_WORLD);
    const SparseRows s = graph(GetParam(), testing_graphs::path_edges(GetParam()));
    const SpectralEmbedding e = embed(comm, s, 2, 6);
    for (int k = 0; k < 6; ++k) {
        EXPECT_NEAR(e.eigenvalues[static_cast<std::size_t>(k)],
                    std::cos(std::numbers::pi * k / (GetParam() - 1)), 1e-8);
    }
    EXPECT_LT(residual(s, e, 0.0), 1e-6);
}

TEST_P(KnownSpectrum, OfACycleWithAllItsDoubleEigenvalues) {
    const Comm comm(MPI_COMM_WORLD);
    const SparseRows s = graph(GetParam(), testing_graphs::cycle_edges(GetParam()));
    const SpectralEmbedding e = embed(comm, s, 2, 7);
    for (int k = 0; k < 7; ++k) {
        const double expected = std::cos(2.0 * std::numbers::pi * ((k + 1) / 2) / GetParam());
        EXPECT_NEAR(e.eigenvalues[static_cast<std::size_t>(k)], expected, 1e-8);
    }
    EXPECT_LT(residual(s, e, 0.0), 1e-6);
}

TEST_P(KnownSpectrum, OfCliquesAndNothingElse) {
    // A clique of m nodes has 1 once and -1/(m-1) for the rest.
    const Comm comm(MPI_COMM_WORLD);
    const int m = GetParam() / 3;
    std::vector<Edge> edges;
    for (int c = 0; c < 3; ++c) {
        const std::vector<Edge> clique = testing_graphs::clique_edges(c * m, m, 1.0 + c);
        edges.insert(edges.end(), clique.begin(), clique.end());
    }
    const SpectralEmbedding e = embed(comm, graph(3 * m, edges), 3, 5);
    for (int k = 0; k < 5; ++k) {
        EXPECT_NEAR(e.eigenvalues[static_cast<std::size_t>(k)], k < 3 ? 1.0 : -1.0 / (m - 1), 1e-8);
    }
}

INSTANTIATE_TEST_SUITE_P(DenseAndSparse, KnownSpectrum, testing::Values(60, 300));

TEST(NormalizedCut, SeparatesTwoCliquesAtTheBridge) {
    const Comm comm(MPI_COMM_WORLD);
    for (const int n : {6, 90}) {
        std::vector<Edge> edges = testing_graphs::clique_edges(0, n);
        const std::vector<Edge> other = testing_graphs::clique_edges(n, n);
        edges.insert(edges.end(), other.begin(), other.end());
        edges.push_back({n - 1, n, 0.5});
        const SparseRows s = graph(2 * n, edges);
        const std::vector<int> labels = cut_embedding(embed(comm, s, 2, 2), 2, 2 * n);
        for (int i = 0; i < 2 * n; ++i) {
            EXPECT_EQ(labels[static_cast<std::size_t>(i)] == labels[0], i < n) << "node " << i;
        }
    }
}

TEST(NormalizedCut, FindsBlocksOnAnyNumberOfRanks) {
    const Comm comm(MPI_COMM_WORLD);
    const Comm self(MPI_COMM_SELF);
    for (const double weak : {0.0, 0.2}) {
        const SparseRows s = graph(60 * 5, testing_graphs::block_edges(5, 60, weak, 42));
        const SpectralEmbedding shared = embed(comm, s, 5, 7);
        const SpectralEmbedding alone = embed(self, s, 5, 7);
        ASSERT_EQ(shared.eigenvalues.size(), alone.eigenvalues.size());
        for (std::size_t k = 0; k < 7; ++k) EXPECT_NEAR(shared.eigenvalues[k], alone.eigenvalues[k], 1e-8);
        EXPECT_LT(residual(s, shared, 0.0), 1e-6);
        std::vector<int> truth;
        for (int i = 0; i < 300; ++i) truth.push_back(i % 5);
        EXPECT_TRUE(same_partition(cut_embedding(shared, 5, 300), truth));
        EXPECT_TRUE(same_partition(cut_embedding(alone, 5, 300), truth));
        EXPECT_EQ(shared.degrees, alone.degrees);
    }
}

/// Residuals of 1e-4 and entries in single precision: eigenvalues are wrong by the square of the residual
/// over the gap to the others, and all copies of the double ones are still found.
TEST(NormalizedCut, WithCoarseVectorsKeepsEigenvaluesAndBlocks) {
    const Comm comm(MPI_COMM_WORLD);
    SpectralOptions coarse;
    coarse.tolerance = 1e-4;
    const SparseRows blocks = graph(60 * 5, testing_graphs::block_edges(5, 60, 0.2, 42));
    const SpectralEmbedding fine = embed(comm, blocks, 5, 5);
    const SpectralEmbedding rough = spectral_embedding(comm, owned_rows(comm, blocks), 5, 5, coarse);
    for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(rough.eigenvalues[k], fine.eigenvalues[k], 1e-6);
    EXPECT_LT(residual(blocks, rough, 0.0), 0.1);
    EXPECT_GT(residual(blocks, rough, 0.0), residual(blocks, fine, 0.0));
    std::vector<int> truth;
    for (int i = 0; i < 300; ++i) truth.push_back(i % 5);
    EXPECT_TRUE(same_partition(cut_embedding(rough, 5, 300), truth));

    const SparseRows cycle = graph(300, testing_graphs::cycle_edges(300));
    const SpectralEmbedding ring = spectral_embedding(comm, owned_rows(comm, cycle), 2, 7, coarse);
    for (int k = 0; k < 7; ++k) {
        const double expected = std::cos(2.0 * std::numbers::pi * ((k + 1) / 2) / 300);
        EXPECT_NEAR(ring.eigenvalues[static_cast<std::size_t>(k)], expected, 1e-5);
    }
}

TEST(NormalizedCut, TheOffsetOfThePapersCodeChangesTheOperatorAsWritten) {
    // (S + .5 I) y = value (D + I) y; on a regular graph of degree d the largest is (d + .5) / (d + 1).
    const Comm comm(MPI_COMM_WORLD);
    for (const int n : {50, 200}) {
        const SparseRows s = graph(n, testing_graphs::cycle_edges(n));
        const SpectralEmbedding e = embed(comm, s, 2, 3, 0.5);
        EXPECT_NEAR(e.eigenvalues[0], 2.5 / 3.0, 1e-9);
        EXPECT_NEAR(e.eigenvalues[1], (2.0 * std::cos(2.0 * std::numbers::pi / n) + 0.5) / 3.0, 1e-9);
        EXPECT_NEAR(e.eigenvalues[2], e.eigenvalues[1], 1e-9);
        EXPECT_LT(residual(s, e, 0.5), 1e-6);
    }
}

TEST(NormalizedCut, CoordinatesHaveTheNormOfTheConstantOne) {
    const Comm comm(MPI_COMM_WORLD);
    const SpectralEmbedding e = embed(comm, graph(200, testing_graphs::block_edges(2, 100, 0.2, 1)), 2, 4);
    for (Eigen::Index k = 0; k < 4; ++k) EXPECT_NEAR(e.coordinates.col(k).norm(), std::sqrt(200.0), 1e-9);
}

TEST(NormalizedCut, SetsIsolatedPatchesAndPairsAside) {
    const Comm comm(MPI_COMM_WORLD);
    std::vector<Edge> edges = testing_graphs::block_edges(3, 60, 0.1, 8);
    edges.push_back({181, 182, 100.0});
    const SparseRows s = graph(184, edges);  // 180 and 183 alone, 181-182 a pair
    const SpectralEmbedding e = embed(comm, s, 3, 3);
    EXPECT_EQ(e.rows.size(), 180U);
    const std::vector<int> labels = cut_embedding(e, 3, 184);
    for (const std::size_t i : {180U, 181U, 182U, 183U}) EXPECT_EQ(labels[i], -1);
    EXPECT_LT(e.eigenvalues[1], 1.0);
}

TEST(NormalizedCut, KeepsComponentsAsLargeAsAPart) {
    const Comm comm(MPI_COMM_WORLD);
    const SpectralEmbedding e = embed(comm, graph(180, testing_graphs::block_edges(3, 60, 0.0, 8)), 3, 6);
    EXPECT_NEAR(e.eigenvalues[2], 1.0, 1e-12);
    EXPECT_LT(e.eigenvalues[3], 0.5);
    const SpectralEmbedding two = embed(comm, graph(180, testing_graphs::block_edges(3, 60, 0.0, 8)), 2, 2);
    EXPECT_EQ(two.rows.size(), 120U)
        << "more components than parts: the smaller ones follow their neighbours";
}

TEST(NormalizedCut, RefusesAnEmptyGraphOnAllRanks) {
    const Comm comm(MPI_COMM_WORLD);
    try {
        embed(comm, graph(40, {}), 2, 2);
        FAIL() << "no throw";
    } catch (const AgreedError& error) {
        EXPECT_EQ(error.code(), ExitCode::input);
        EXPECT_NE(std::string(error.what()).find("nothing to cut"), std::string::npos);
    }
    EXPECT_THROW(embed(comm, graph(40, {{0, 1}, {1, 2}}), 4, 4), AgreedError);
}

TEST(NormalizedCut, NamesTheResidualWhenItDoesNotConverge) {
    const Comm comm(MPI_COMM_WORLD);
    SpectralOptions options;
    options.tolerance = 1e-14;
    options.max_restarts = 1;
    const SparseRows s = owned_rows(comm, graph(2000, testing_graphs::path_edges(2000)));
    try {
        spectral_embedding(comm, s, 2, 8, options);
        FAIL() << "no throw";
    } catch (const AgreedError& error) {
        EXPECT_EQ(error.code(), ExitCode::not_converged);
        EXPECT_NE(std::string(error.what()).find("residual"), std::string::npos);
        EXPECT_EQ(std::string(error.what()).find("residual 0;"), std::string::npos) << error.what();
    }
}

/// Two meshes of two parts of n nodes each, node ((mesh * 2 + part) * n + k); all pairs linked: 1 inside a
/// part of a mesh, `mesh` inside a mesh, `part` inside a part, else not.
SparseRows two_by_two(int n, double mesh, double part) {
    std::vector<Edge> edges;
    for (int i = 0; i < 4 * n; ++i) {
        for (int j = i + 1; j < 4 * n; ++j) {
            const bool same_mesh = i / (2 * n) == j / (2 * n);
            const bool same_part = i / n % 2 == j / n % 2;
            const double weight = same_mesh && same_part ? 1.0 : same_mesh ? mesh : same_part ? part : 0.0;
            if (weight > 0.0) edges.push_back({i, j, weight});
        }
    }
    return graph(4 * n, edges);
}

class MeshBalance : public testing::TestWithParam<int> {};

TEST_P(MeshBalance, TakesTauFromWhatTellsMeshesApartAndNothingFromWhatTellsParts) {
    const Comm comm(MPI_COMM_WORLD);
    const int n = GetParam();
    const double mesh = 0.5;
    const double part = 0.3;
    const double degree = n - 1 + n * (mesh + part);
    const double of_meshes = (n - 1 + n * (mesh - part)) / degree;
    const double of_parts = (n - 1 - n * (mesh - part)) / degree;
    const SparseRows s = two_by_two(n, mesh, part);
    std::vector<int> mesh_of;
    std::vector<int> part_of;
    for (int i = 0; i < 4 * n; ++i) {
        mesh_of.push_back(i / (2 * n));
        part_of.push_back(i / n % 2);
    }
    const SpectralEmbedding plain = embed(comm, s, 2, 3);
    EXPECT_NEAR(plain.eigenvalues[1], of_meshes, 1e-8);
    EXPECT_TRUE(same_partition(cut_embedding(plain, 2, 4 * n), mesh_of));
    SpectralOptions options;
    options.mesh_balance = 0.3;
    const SpectralEmbedding balanced = spectral_embedding(comm, owned_rows(comm, s), 2, 3, options, mesh_of);
    EXPECT_NEAR(balanced.eigenvalues[0], 1.0, 1e-8);
    EXPECT_NEAR(balanced.eigenvalues[1], of_parts, 1e-8);
    EXPECT_NEAR(balanced.eigenvalues[2], of_meshes - 0.3, 1e-8);
    EXPECT_TRUE(same_partition(cut_embedding(balanced, 2, 4 * n), part_of));
}

INSTANTIATE_TEST_SUITE_P(DenseAndSparse, MeshBalance, testing::Values(10, 50));

TEST(MeshBalanceEdges, OfOneMeshChangesNothing) {
    const Comm comm(MPI_COMM_WORLD);
    const SparseRows s = owned_rows(comm, graph(200, testing_graphs::path_edges(200)));
    SpectralOptions options;
    options.mesh_balance = 0.9;
    const SpectralEmbedding e = spectral_embedding(comm, s, 2, 4, options, std::vector<int>(200, 0));
    for (int k = 0; k < 4; ++k) {
        EXPECT_NEAR(e.eigenvalues[static_cast<std::size_t>(k)], std::cos(std::numbers::pi * k / 199.0), 1e-8);
    }
}

TEST(MeshBalanceEdges, GoesNeitherWithAnOffsetNorWithoutMeshes) {
    const Comm comm(MPI_COMM_WORLD);
    const SparseRows s = owned_rows(comm, graph(40, testing_graphs::path_edges(40)));
    SpectralOptions options;
    options.mesh_balance = 0.3;
    EXPECT_THROW(spectral_embedding(comm, s, 2, 4, options), AgreedError);
    options.offset = 0.5;
    EXPECT_THROW(spectral_embedding(comm, s, 2, 4, options, std::vector<int>(40, 0)), AgreedError);
}

TEST(GraphComponents, AreTheSameOnAnyNumberOfRanks) {
    const Comm comm(MPI_COMM_WORLD);
    std::vector<Edge> edges;
    for (int i = 0; i < 200; ++i) {
        if (i + 3 < 200) edges.push_back({i, i + 3});  // three interleaved chains
    }
    const SparseRows s = graph(203, edges);
    const std::vector<int> component = connected_components(comm, owned_rows(comm, s));
    for (int i = 0; i < 200; ++i) EXPECT_EQ(component[static_cast<std::size_t>(i)], i % 3);
    for (int i = 200; i < 203; ++i) EXPECT_EQ(component[static_cast<std::size_t>(i)], i);
}

}  // namespace
}  // namespace coseg
