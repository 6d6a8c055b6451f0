#include "solvers/variants/subspace_solver.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "io/data_files/problem_file.hpp"
#include "tests/support/subspace_problems.hpp"

namespace coseg {
namespace {

/// Every row is a certificate of its own, and the last one is the answer's.
void expect_history(const SolveResult& result) {
    ASSERT_FALSE(result.history.empty());
    EXPECT_LE(result.history.size(), most_history_rows);
    const double rounding = 1e-12 * result.objective_at_zero;
    for (std::size_t k = 0; k < result.history.size(); ++k) {
        const HistoryRow& row = result.history[k];
        EXPECT_LE(row.lower_bound, result.objective + rounding) << "row " << k;
        EXPECT_GE(row.objective, result.lower_bound - rounding) << "row " << k;
        if (k == 0) continue;
        EXPECT_GT(row.pass, result.history[k - 1].pass);
        EXPECT_GE(row.iterations, result.history[k - 1].iterations);
        EXPECT_GE(row.lower_bound, result.history[k - 1].lower_bound - rounding);
    }
    const HistoryRow& last = result.history.back();
    EXPECT_EQ(last.pass, result.passes);
    EXPECT_EQ(last.iterations, result.iterations);
    EXPECT_EQ(last.objective, result.objective);
    EXPECT_EQ(last.lower_bound, result.lower_bound);
    EXPECT_EQ(last.relative_gap, result.relative_gap);
    EXPECT_EQ(last.working_pairs, result.working_pairs);
}

/// Solves on all ranks and on rank 0 alone: the bits must agree, and the certificate must hold. Returns what
/// all ranks found, with the coefficients of all columns. (On every rank alone it would take as many times as
/// long, for the same.)
SolveResult expect_same_on_any_ranks(const SubspaceProblem& problem, const SolveOptions& options) {
    const Comm world(MPI_COMM_WORLD);
    SolveResult shared = solve_subspace(world, problem, options);
    expect_history(shared);
    EXPECT_EQ(shared.coefficients.columns,
              block_range(problem.size(), world.size(), world.rank(), coefficient_tile));
    for (const double objective : all_gather(world, std::span<const double>(&shared.objective, 1)))
        EXPECT_EQ(objective, shared.objective);
    shared.coefficients = all_gathered(world, shared.coefficients);
    if (world.is_root()) expect_same_solution(shared, solve_subspace(Comm(MPI_COMM_SELF), problem, options));
    const double objective = subspace_objective(problem, dense_weights(shared.coefficients));
    EXPECT_NEAR(objective, shared.objective, 1e-12 * shared.objective_at_zero);
    EXPECT_LE(shared.lower_bound, shared.objective);
    return shared;
}

SolveOptions precise(SolverChoice solver, double gap = 1e-8) {
    return {.gap = gap, .max_iterations = 100000, .max_seconds = 3600.0, .solver = solver};
}

TEST(SubspaceSolver, PaperScopeDense) {
    // Three tiles of columns; down to 1e-8 it would be thousands of iterations, which OracleProblems has
    // already.
    SubspaceProblem problem = random_subspace_problem(3, 12, 70, 10, 21);
    problem.lambda = 5.0;
    const SolveResult result = expect_same_on_any_ranks(problem, precise(SolverChoice::dense, 1e-4));
    EXPECT_EQ(result.reason, StopReason::gap_reached);
    EXPECT_LE(result.objective - result.lower_bound, 1e-4 * result.objective);
}

TEST(SubspaceSolver, MeshScope) {
    for (const double lambda : {0.1, 100.0}) {
        SubspaceProblem problem = random_subspace_problem(3, 12, 70, 10, 22);
        problem.scope = PenaltyScope::meshes;
        problem.lambda = lambda;
        const SolveResult result = expect_same_on_any_ranks(problem, precise(SolverChoice::automatic, 1e-6));
        EXPECT_EQ(result.reason, StopReason::gap_reached);
        EXPECT_LE(result.relative_gap, 1e-6);
        EXPECT_GT(result.nonzero_groups, 0);
    }
}

TEST(SubspaceSolver, MeshScopeHasNoPairsInsideAMeshInWhateverOrderMeshesCome) {
    SubspaceProblem problem = random_subspace_problem(2, 10, 40, 8, 23);
    problem.scope = PenaltyScope::meshes;
    problem.lambda = 2.0;
    for (std::size_t j = 0; j < problem.mesh_of.size(); ++j)
        problem.mesh_of[j] = static_cast<int>((j * 7) % 5) * 3;
    const SolveResult result = expect_same_on_any_ranks(problem, precise(SolverChoice::automatic, 1e-6));
    for (std::size_t j = 0; j < problem.mesh_of.size(); ++j) {
        for (auto e = result.coefficients.offsets[j]; e < result.coefficients.offsets[j + 1]; ++e) {
            EXPECT_NE(
                problem
                    .mesh_of[static_cast<std::size_t>(result.coefficients.rows[static_cast<std::size_t>(e)])],
                problem.mesh_of[j]);
        }
    }
}

TEST(SubspaceSolver, MeshScopeKeepsToTheAllowedMeshes) {
    SubspaceProblem problem = random_subspace_problem(2, 10, 60, 10, 24);
    problem.scope = PenaltyScope::meshes;
    problem.allowed_meshes = {{1, 2}, {0, 5}, {3}, {2, 4}, {}, {0, 1}};
    const SolveResult result = expect_same_on_any_ranks(problem, precise(SolverChoice::automatic, 1e-6));
    EXPECT_EQ(result.reason, StopReason::gap_reached);
    for (std::size_t j = 0; j < problem.mesh_of.size(); ++j) {
        const auto& allowed = problem.allowed_meshes[static_cast<std::size_t>(problem.mesh_of[j])];
        for (auto e = result.coefficients.offsets[j]; e < result.coefficients.offsets[j + 1]; ++e) {
            const int row = result.coefficients.rows[static_cast<std::size_t>(e)];
            EXPECT_TRUE(std::ranges::binary_search(allowed, problem.mesh_of[static_cast<std::size_t>(row)]));
        }
        EXPECT_EQ(allowed.empty(), result.coefficients.offsets[j] == result.coefficients.offsets[j + 1]);
    }
}

class UglyProblem : public testing::TestWithParam<SolverChoice> {
  protected:
    static void expect_certified(SubspaceProblem problem) {
        for (const PenaltyScope scope : {PenaltyScope::rows, PenaltyScope::meshes}) {
            problem.scope = scope;
            if (scope == PenaltyScope::meshes && GetParam() == SolverChoice::dense) continue;
            const SolveResult result = expect_same_on_any_ranks(problem, precise(GetParam(), 1e-6));
            EXPECT_TRUE(result.reason == StopReason::gap_reached ||
                        result.reason == StopReason::residual_reached);
            EXPECT_LE(result.relative_gap, 1e-5);
        }
    }
};

TEST_P(UglyProblem, OneColumnHasNoPairs) { expect_certified(random_subspace_problem(2, 5, 1, 1, 31)); }

TEST_P(UglyProblem, TwoColumns) { expect_certified(random_subspace_problem(2, 5, 2, 1, 32)); }

TEST_P(UglyProblem, OneFeature) { expect_certified(random_subspace_problem(1, 9, 40, 4, 33)); }

TEST_P(UglyProblem, FeaturesOfDifferentLengths) {
    SubspaceProblem problem = random_subspace_problem(2, 9, 40, 4, 34);
    problem.features = std::vector<Eigen::MatrixXd>{problem.features[0],
                                                    random_subspace_problem(1, 4, 40, 4, 35).features[0]};
    problem.lambda = 1.0;
    expect_certified(problem);
}

TEST_P(UglyProblem, DuplicateColumns) {
    SubspaceProblem problem = random_subspace_problem(2, 8, 36, 6, 36);
    change_features(problem, [](Eigen::MatrixXd& x) { x.col(20) = x.col(30) = x.col(3); });
    problem.lambda = 0.5;
    expect_certified(problem);
}

TEST_P(UglyProblem, NoPenalties) {
    SubspaceProblem problem = random_subspace_problem(2, 20, 24, 4, 37);
    problem.alpha = problem.beta = problem.lambda = 0.0;
    expect_certified(problem);
}

TEST_P(UglyProblem, OnePenaltyAtATime) {
    SubspaceProblem problem = random_subspace_problem(2, 12, 24, 4, 38);
    problem.alpha = problem.lambda = 0.0;
    expect_certified(problem);
    std::swap(problem.alpha, problem.beta);
    expect_certified(problem);
    std::swap(problem.alpha, problem.lambda);
    expect_certified(problem);
}

TEST_P(UglyProblem, OptimumIsZeroWhereBetaExceedsEveryInnerProduct) {
    SubspaceProblem problem = random_subspace_problem(2, 8, 40, 8, 39);
    problem.beta = 3.0;  // unit columns: 2 x_i.x_j <= 2
    problem.scope = PenaltyScope::rows;
    const SolveResult result = expect_same_on_any_ranks(problem, precise(GetParam()));
    EXPECT_EQ(result.nonzero_groups, 0);
    EXPECT_EQ(result.objective, result.objective_at_zero);
    EXPECT_EQ(result.reason, StopReason::gap_reached);
    EXPECT_LE(result.relative_gap, 1e-12);
}

TEST_P(UglyProblem, ScalesOfManyOrders) {
    for (const double scale : {1e-6, 1e6}) {
        SubspaceProblem problem = random_subspace_problem(2, 8, 30, 5, 40);
        change_features(problem, [&](Eigen::MatrixXd& x) { x *= scale; });
        problem.lambda = 3.0 * scale * scale;
        problem.alpha *= scale * scale;
        problem.beta *= scale * scale;
        expect_certified(problem);
    }
}

TEST(SubspaceSolver, SmallPenaltiesAreSolvedToTheLastDigits) {
    // More columns than rows: the Gram matrices of the columns' supports are close to singular.
    SubspaceProblem problem = random_subspace_problem(2, 20, 60, 6, 43);
    for (const double lambda : {0.0, 1e-3, 0.1}) {
        problem.lambda = lambda;
        problem.alpha = problem.beta = 0.01;
        const SolveResult result = expect_same_on_any_ranks(problem, precise(SolverChoice::working_set));
        EXPECT_EQ(result.reason, StopReason::gap_reached) << lambda;
        EXPECT_LE(result.relative_gap, 1e-8) << lambda;
        EXPECT_LT(result.iterations, 1000) << lambda;
    }
}

INSTANTIATE_TEST_SUITE_P(Solvers, UglyProblem,
                         testing::Values(SolverChoice::dense, SolverChoice::working_set));

TEST(SubspaceSolver, OracleProblems) {
    const std::filesystem::path folder = oracle_folder();
    for (const char* name : {"problem1.txt", "problem5.txt", "problem6.txt"}) {
        const ProblemFile file = read_problem_file((folder / name).string());
        SubspaceProblem problem;
        problem.features = file.features;
        problem.lambda = file.lambda;
        problem.alpha = file.alpha;
        problem.beta = file.beta;
        for (const SolverChoice solver : {SolverChoice::dense, SolverChoice::working_set}) {
            const SolveResult result = expect_same_on_any_ranks(problem, precise(solver));
            EXPECT_LE(std::abs(result.objective - file.known_upper), 1e-8 * file.known_upper)
                << name << to_string(solver);
            EXPECT_LE(result.lower_bound, file.known_upper) << name << to_string(solver);
            EXPECT_LE(result.relative_gap, 1e-8) << name << to_string(solver);
        }
    }
}

TEST(SubspaceSolver, ALimitIsReported) {
    const Comm world(MPI_COMM_WORLD);
    SubspaceProblem problem = random_subspace_problem(2, 10, 40, 8, 41);
    problem.lambda = 1.0;
    SolveOptions options = precise(SolverChoice::dense, 1e-12);
    options.max_iterations = 3;
    const SolveResult result = solve_subspace(world, problem, options);
    EXPECT_EQ(result.reason, StopReason::iteration_limit);
    EXPECT_GT(result.relative_gap, 1e-12);
    EXPECT_EQ(result.iterations, 3);
}

TEST(SubspaceSolver, BadInputIsRefusedOnAllRanks) {
    const Comm world(MPI_COMM_WORLD);
    const auto refusal = [&](const SubspaceProblem& problem, const SolveOptions& options) -> std::string {
        try {
            solve_subspace(world, problem, options);
        } catch (const AgreedError& error) {
            return error.what();
        }
        return "accepted";
    };
    const SubspaceProblem good = random_subspace_problem(2, 4, 6, 2, 42);
    SubspaceProblem bad = random_subspace_problem(2, 4, 6, 2, 42);
    bad.features.fill(1)(2, 3) = std::nan("");
    EXPECT_NE(refusal(bad, {}).find("feature 2, column 4"), std::string::npos);
    bad = random_subspace_problem(2, 4, 6, 2, 42);
    bad.features.fill(0)(1, 5) = -1.0;
    EXPECT_NE(refusal(bad, {}).find("feature 1, column 6"), std::string::npos);
    bad = random_subspace_problem(2, 4, 6, 2, 42);
    bad.features.fill(1).col(2).setZero();
    EXPECT_NE(refusal(bad, {}).find("feature 2, column 3 is all zeros"), std::string::npos);
    bad = good;
    bad.features = {};
    EXPECT_NE(refusal(bad, {}).find("no feature"), std::string::npos);
    bad = good;
    bad.alpha = -1.0;
    EXPECT_NE(refusal(bad, {}).find("alpha"), std::string::npos);
    bad = good;
    bad.scope = PenaltyScope::meshes;
    bad.mesh_of.pop_back();
    EXPECT_NE(refusal(bad, {}).find("mesh of each"), std::string::npos);
    bad = good;
    bad.scope = PenaltyScope::meshes;
    EXPECT_NE(refusal(bad, {.solver = SolverChoice::dense}).find("row scope only"), std::string::npos);
}

}  // namespace
}  // namespace coseg
