#include "solvers/affinity/affinity.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>

#include "solvers/petsc/petsc_handle.hpp"
#include "tests/support/graphs.hpp"

namespace coseg {
namespace {

using testing_graphs::random_coefficients;

/// ||w_ij|| as a dense matrix, by definition.
Eigen::MatrixXd dense_norms(const SparseCoefficients& complete) {
    Eigen::MatrixXd norms = Eigen::MatrixXd::Zero(complete.size, complete.size);
    for (std::size_t j = 0; j < static_cast<std::size_t>(complete.size); ++j) {
        for (auto k = static_cast<std::size_t>(complete.offsets[j]);
             k < static_cast<std::size_t>(complete.offsets[j + 1]); ++k) {
            double squares = 0.0;
            for (int h = 0; h < complete.features; ++h) {
                squares += std::pow(complete.values[k * static_cast<std::size_t>(complete.features) +
                                                    static_cast<std::size_t>(h)],
                                    2);
            }
            norms(complete.rows[k], static_cast<Eigen::Index>(j)) = std::sqrt(squares);
        }
    }
    return norms;
}

Eigen::MatrixXd dense(const SparseRows& complete) {
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(complete.size, complete.size);
    for (std::size_t r = 0; r < static_cast<std::size_t>(complete.size); ++r) {
        for (auto k = static_cast<std::size_t>(complete.offsets[r]);
             k < static_cast<std::size_t>(complete.offsets[r + 1]); ++k) {
            matrix(static_cast<Eigen::Index>(r), complete.columns[k]) = complete.values[k];
        }
    }
    return matrix;
}

class Affinity : public testing::TestWithParam<int> {};

TEST_P(Affinity, FormulaEightAgreesWithBruteForce) {
    const Comm comm(MPI_COMM_WORLD);
    const Comm self(MPI_COMM_SELF);
    const Eigen::MatrixXd norms = dense_norms(random_coefficients(self, GetParam(), 3, 6, 11));
    const SparseRows mine = symmetric_affinity(comm, random_coefficients(comm, GetParam(), 3, 6, 11));
    EXPECT_EQ(mine.rows, block_range(GetParam(), comm.size(), comm.rank(), row_tile));
    const Eigen::MatrixXd expected = 0.5 * (norms + norms.transpose());
    EXPECT_LT((dense(gather_rows(comm, mine)) - expected).cwiseAbs().maxCoeff(), 1e-15);
}

TEST_P(Affinity, LinksGiveEveryPatchTheSameSay) {
    const Comm comm(MPI_COMM_WORLD);
    const Comm self(MPI_COMM_SELF);
    Eigen::MatrixXd shares = dense_norms(random_coefficients(self, GetParam(), 2, 5, 3));
    for (Eigen::Index j = 0; j < shares.cols(); ++j) {
        if (shares.col(j).sum() > 0.0) shares.col(j) /= shares.col(j).sum();
    }
    const SparseRows mine = normalized_links(comm, random_coefficients(comm, GetParam(), 2, 5, 3));
    const Eigen::MatrixXd expected = shares + shares.transpose();
    EXPECT_LT((dense(gather_rows(comm, mine)) - expected).cwiseAbs().maxCoeff(), 1e-15);
}

TEST_P(Affinity, HasTheSameBitsAsOnOneRank) {
    const Comm comm(MPI_COMM_WORLD);
    const Comm self(MPI_COMM_SELF);
    const SparseRows alone = normalized_links(self, random_coefficients(self, GetParam(), 4, 9, 5));
    const SparseRows shared =
        gather_rows(comm, normalized_links(comm, random_coefficients(comm, GetParam(), 4, 9, 5)));
    EXPECT_EQ(shared.offsets, alone.offsets);
    EXPECT_EQ(shared.columns, alone.columns);
    EXPECT_EQ(shared.values, alone.values);
}

// 5 and 32: one rank owns everything; 33 and 70: uneven tiles; 301: several tiles on each of 4 ranks.
INSTANTIATE_TEST_SUITE_P(Sizes, Affinity, testing::Values(5, 32, 33, 70, 301));

TEST(AffinityTerms, MinimaRuleWeakensOnlyWhatExists) {
    const Comm comm(MPI_COMM_WORLD);
    const SparseRows complete = testing_graphs::graph(80, {{0, 1, 2.0}, {1, 70, 4.0}, {2, 3, 8.0}});
    SparseRows mine = testing_graphs::owned_rows(comm, complete);
    apply_minima_rule(mine, {{0, 1, 1.0, 0.25}, {1, 70, 9.0, 1.0}, {4, 5, 1.0, 0.5}});
    const Eigen::MatrixXd result = dense(gather_rows(comm, mine));
    EXPECT_EQ(result(0, 1), 1.5);
    EXPECT_EQ(result(1, 0), 1.5);
    EXPECT_EQ(result(1, 70), 0.0);
    EXPECT_EQ(result(70, 1), 0.0);
    EXPECT_EQ(result(2, 3), 8.0);
    EXPECT_EQ(result(4, 5), 0.0);
}

TEST(AffinityTerms, AdjacencyGivesEveryMeshTheSameTotal) {
    const std::vector<int> mesh_of = {0, 0, 0, 1, 1, 2};
    const SparseRows a =
        adjacency_affinity({0, 6}, {{0, 1, 2.0, 0.5}, {1, 2, 1.0, 0.0}, {3, 4, 0.3, 0.2}}, mesh_of);
    const Eigen::MatrixXd d = dense(a);
    EXPECT_DOUBLE_EQ(d.topLeftCorner(3, 3).sum(), 1.0);
    EXPECT_DOUBLE_EQ(d.block(3, 3, 2, 2).sum(), 1.0);
    EXPECT_EQ(d.row(5).sum(), 0.0);
    EXPECT_DOUBLE_EQ(d(0, 1) / d(1, 2), 2.0 * 0.03125);
    EXPECT_EQ(d, d.transpose());
}

TEST(AffinityTerms, OverlapIsTheIntersectionOverUnion) {
    const Eigen::MatrixXd d = dense(overlap_affinity({0, 4}, {{0, 2, 0.5}, {1, 3, 0.25}}, 4));
    EXPECT_EQ(d(0, 2), 0.5);
    EXPECT_EQ(d(3, 1), 0.25);
    EXPECT_EQ(d.sum(), 1.5);
}

TEST(AffinityTerms, RelationsComeInOneOrderWhoeverOwnsThem) {
    const Comm comm(MPI_COMM_WORLD);
    std::vector<GlobalPatchNeighbors> mine;
    for (int m = 9; m >= 0; --m) {
        if (m % comm.size() == comm.rank()) mine.push_back({2 * m + 1, 2 * m, 0.5 * m, 0.1});
    }
    const std::vector<GlobalPatchNeighbors> all = gather_patch_pairs(comm, mine, 20);
    ASSERT_EQ(all.size(), 10U);
    for (int m = 0; m < 10; ++m) {
        EXPECT_EQ(all[static_cast<std::size_t>(m)].patch_a, 2 * m);
        EXPECT_EQ(all[static_cast<std::size_t>(m)].patch_b, 2 * m + 1);
        EXPECT_EQ(all[static_cast<std::size_t>(m)].boundary_length, 0.5 * m);
    }
    EXPECT_THROW(gather_patch_pairs(comm, mine, 19), AgreedError);
}

TEST(PetscHandle, RefusesWhatDoesNotFitAPetscInt) {
    EXPECT_EQ(petsc_int(7, "rows"), 7);
    if (sizeof(PetscInt) == 4) {
        try {
            petsc_int(std::int64_t{1} << 31U, "affinities of one rank");
            FAIL() << "no throw";
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find("affinities of one rank: 2147483648"),
                      std::string::npos);
        }
    }
}

TEST(PetscHandle, MovesAndReportsPetscsOwnMessage) {
    PetscVector vector;
    check(VecCreateSeq(PETSC_COMM_SELF, 3, vector.out()), "VecCreateSeq");
    PetscVector other(std::move(vector));
    EXPECT_FALSE(vector);
    ASSERT_TRUE(other);
    check(PetscPushErrorHandler(PetscIgnoreErrorHandler, nullptr), "PetscPushErrorHandler");
    try {
        check(VecSetType(other.get(), "no such type"), "VecSetType");
        ADD_FAILURE() << "no throw";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::internal);
        EXPECT_NE(std::string(error.what()).find("VecSetType failed"), std::string::npos);
        EXPECT_NE(std::string(error.what()).find("no such type"), std::string::npos) << error.what();
    }
    check(PetscPopErrorHandler(), "PetscPopErrorHandler");
}

}  // namespace
}  // namespace coseg
