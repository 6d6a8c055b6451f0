#include "solvers/variants/subspace_variants.hpp"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "tests/support/errors.hpp"
#include "tests/support/subspace_problems.hpp"

namespace coseg {
namespace {

const SolveOptions small_gap{
    .gap = 1e-6, .max_iterations = 100000, .max_seconds = 3600.0, .solver = SolverChoice::automatic};

/// The last row of the history is the answer's.
void expect_own_history(const SolveResult& result) {
    ASSERT_FALSE(result.history.empty());
    const HistoryRow& last = result.history.back();
    EXPECT_DOUBLE_EQ(last.objective, result.objective);
    EXPECT_DOUBLE_EQ(last.lower_bound, result.lower_bound);
    EXPECT_NEAR(last.relative_gap, result.relative_gap, 1e-12);
    EXPECT_EQ(last.working_pairs, result.working_pairs);
    EXPECT_GT(result.history.front().relative_gap, last.relative_gap);
}

/// Solves on all ranks and on rank 0 alone: figures and coefficients must agree to the bit. Returns what all
/// ranks found, with the coefficients of all columns.
SolveResult solve_both_ways(const SubspaceProblem& problem, SubspaceVariant variant, int feature = 0,
                            const SolveOptions& options = small_gap) {
    const Comm world(MPI_COMM_WORLD);
    SolveResult shared = solve_variant(world, problem, variant, feature, options);
    shared.coefficients = all_gathered(world, shared.coefficients);
    if (world.is_root())
        expect_same_solution(shared, solve_variant(Comm(MPI_COMM_SELF), problem, variant, feature, options));
    expect_own_history(shared);
    EXPECT_LE(shared.lower_bound, shared.objective);
    EXPECT_EQ(shared.reason, StopReason::gap_reached) << to_string(variant);
    EXPECT_GT(shared.nonzero_groups, 0);
    return shared;
}

SubspaceProblem sample() {
    SubspaceProblem problem = random_subspace_problem(3, 8, 70, 10, 51);
    problem.lambda = 0.5;
    problem.alpha = 0.05;
    return problem;
}

SubspaceProblem of_features(SubspaceProblem problem, const std::vector<Eigen::MatrixXd>& features) {
    problem.features = features;
    return problem;
}

Eigen::MatrixXd stacked(const SubspaceProblem& problem) {
    Eigen::MatrixXd all(24, problem.size());
    all << problem.features[0], problem.features[1], problem.features[2];
    return all;
}

TEST(SubspaceVariants, ASingleFeatureIsTheProblemOfThatFeature) {
    for (const PenaltyScope scope : {PenaltyScope::rows, PenaltyScope::meshes}) {
        SubspaceProblem problem = sample();
        problem.scope = scope;
        const SolveResult one = solve_both_ways(problem, SubspaceVariant::single_feature, 1);
        const SubspaceProblem alone = of_features(problem, {problem.features[1]});
        EXPECT_EQ(one.objective, solve_subspace(Comm(MPI_COMM_SELF), alone, small_gap).objective);
        EXPECT_EQ(one.coefficients.features, 1);
    }
    const SubspaceProblem problem = sample();
    EXPECT_EQ(test::error_of([&] {
                  solve_variant(Comm(MPI_COMM_WORLD), problem, SubspaceVariant::single_feature, 3, small_gap);
              }).code,
              ExitCode::usage);
}

TEST(SubspaceVariants, IndependentFeaturesAreTheProblemWithoutAlphaWhereItSeparates) {
    SubspaceProblem problem = sample();
    problem.alpha = 0.0;
    const SolveResult joint = solve_subspace(Comm(MPI_COMM_SELF), problem, small_gap);
    const SolveResult apart = solve_both_ways(problem, SubspaceVariant::independent);
    EXPECT_NEAR(apart.objective, joint.objective, 2e-6 * joint.objective);
    EXPECT_EQ(apart.coefficients.features, 3);
    const double objective = subspace_objective(problem, dense_weights(apart.coefficients));
    EXPECT_NEAR(apart.objective, objective, 1e-12 * apart.objective_at_zero);
}

TEST(SubspaceVariants, IndependentFeaturesOfScopeMeshAddUp) {
    SubspaceProblem problem = sample();
    problem.scope = PenaltyScope::meshes;
    const SolveResult apart = solve_both_ways(problem, SubspaceVariant::independent);
    double objective = 0.0, bound = 0.0;
    for (const Eigen::MatrixXd& feature : problem.features.matrices()) {
        const SolveResult one =
            solve_subspace(Comm(MPI_COMM_SELF), of_features(problem, {feature}), small_gap);
        objective += one.objective;
        bound += one.lower_bound;
    }
    EXPECT_EQ(apart.objective, objective);
    EXPECT_EQ(apart.lower_bound, bound);
}

TEST(SubspaceVariants, ConcatenatedFeaturesAreOneLongFeature) {
    for (const PenaltyScope scope : {PenaltyScope::rows, PenaltyScope::meshes}) {
        SubspaceProblem problem = sample();
        problem.scope = scope;
        const SolveResult one = solve_both_ways(problem, SubspaceVariant::concatenated);
        const SubspaceProblem stack = of_features(problem, {stacked(problem)});
        EXPECT_EQ(one.objective, solve_subspace(Comm(MPI_COMM_SELF), stack, small_gap).objective);
    }
}

TEST(SubspaceVariants, SsqpHasTheLambdaTermAlone) {
    SubspaceProblem problem = sample();
    problem.scope = PenaltyScope::meshes;  // not kept
    const SolveResult one = solve_both_ways(problem, SubspaceVariant::ssqp);
    SubspaceProblem stack = of_features(problem, {stacked(problem)});
    stack.scope = PenaltyScope::rows;
    stack.alpha = stack.beta = 0.0;
    const double objective = subspace_objective(stack, dense_weights(one.coefficients));
    EXPECT_NEAR(one.objective, objective, 1e-12 * one.objective_at_zero);
}

TEST(SubspaceVariants, NonnegativeL1IsTheProblemWithBetaAlone) {
    const SubspaceProblem problem = sample();
    const SolveResult one = solve_both_ways(problem, SubspaceVariant::ssc);
    SubspaceProblem stack = of_features(problem, {stacked(problem)});
    stack.alpha = stack.lambda = 0.0;
    const SolveResult joint = solve_subspace(Comm(MPI_COMM_SELF), stack, small_gap);
    EXPECT_NEAR(one.objective, joint.objective, 2e-6 * joint.objective);
    EXPECT_LE(one.lower_bound, joint.objective);
    for (const double value : one.coefficients.values) EXPECT_GT(value, 0.0);
}

/// Optimality of the lasso: 2 x_i . r = beta sign(w_i) where w_i is not 0, else within [-beta, beta].
TEST(SubspaceVariants, SignedL1SatisfiesTheOptimalityConditionsOfTheLasso) {
    SubspaceProblem problem = sample();
    problem.beta = 0.05;
    SolveOptions options = small_gap;
    options.gap = 1e-11;
    const SolveResult result = solve_both_ways(problem, SubspaceVariant::ssc_signed, 0, options);
    const Eigen::MatrixXd x = stacked(problem);
    const Eigen::MatrixXd w = dense_weights(result.coefficients).front();
    const Eigen::MatrixXd scores = 2.0 * x.transpose() * (x - x * w);
    int negative = 0;
    for (Eigen::Index j = 0; j < w.cols(); ++j) {
        for (Eigen::Index i = 0; i < w.rows(); ++i) {
            if (i == j) {
                EXPECT_EQ(w(i, j), 0.0);
            } else if (w(i, j) == 0.0) {
                EXPECT_LE(std::abs(scores(i, j)), problem.beta + 1e-5);
            } else {
                EXPECT_NEAR(scores(i, j), w(i, j) > 0.0 ? problem.beta : -problem.beta, 1e-5);
                negative += w(i, j) < 0.0 ? 1 : 0;
            }
        }
    }
    EXPECT_GT(negative, 0);
    EXPECT_NEAR((x - x * w).squaredNorm() + problem.beta * w.cwiseAbs().sum(), result.objective,
                1e-12 * result.objective_at_zero);
    // A larger feasible set has a smaller optimum.
    EXPECT_LE(result.objective, solve_both_ways(problem, SubspaceVariant::ssc).objective);
}

TEST(SubspaceVariants, L1WithoutPenaltyIsLeastSquares) {
    SubspaceProblem problem = random_subspace_problem(1, 30, 12, 4, 52);
    problem.beta = 0.0;
    SolveOptions options = small_gap;
    // Without a penalty no dual is feasible but by rounding: the point counts, not the bound.
    options.gap = 1e-3;
    options.max_iterations = 20000;
    const SolveResult result =
        solve_variant(Comm(MPI_COMM_WORLD), problem, SubspaceVariant::ssc_signed, 0, options);
    const Eigen::MatrixXd x = problem.features[0];
    double squares = 0.0;
    for (Eigen::Index j = 0; j < x.cols(); ++j) {
        Eigen::MatrixXd others(x.rows(), x.cols() - 1);
        others << x.leftCols(j), x.rightCols(x.cols() - 1 - j);
        squares += (x.col(j) - others * others.colPivHouseholderQr().solve(x.col(j))).squaredNorm();
    }
    EXPECT_NEAR(result.objective, squares, 1e-6 * squares);
}

TEST(SubspaceVariants, DuplicateColumnsAndOneColumn) {
    for (const SubspaceVariant variant : {SubspaceVariant::ssc, SubspaceVariant::ssc_signed}) {
        SubspaceProblem problem = sample();
        problem.beta = 1e-2;
        change_features(problem, [](Eigen::MatrixXd& x) { x.col(33) = x.col(2); });
        solve_both_ways(problem, variant);
        const SubspaceProblem one = random_subspace_problem(2, 5, 1, 1, 53);
        const SolveResult result = solve_variant(Comm(MPI_COMM_WORLD), one, variant, 0, small_gap);
        EXPECT_EQ(result.nonzero_groups, 0);
        EXPECT_EQ(result.objective, result.objective_at_zero);
    }
}

}  // namespace
}  // namespace coseg
