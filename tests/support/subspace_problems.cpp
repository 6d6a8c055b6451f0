#include "tests/support/subspace_problems.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <span>

#include "src/base/seeded_random.hpp"

namespace coseg {

SubspaceProblem random_subspace_problem(int features, int rows, int columns, int patches,
                                        std::uint64_t seed) {
    SubspaceProblem problem;
    std::vector<Eigen::MatrixXd> matrices;
    constexpr int parts = 4;
    for (int h = 0; h < features; ++h) {
        Eigen::MatrixXd x(rows, columns);
        for (int j = 0; j < columns; ++j) {
            SeededStream prototype(
                hash_words({seed, 1, static_cast<std::uint64_t>(h), static_cast<std::uint64_t>(j % parts)}));
            SeededStream own(
                hash_words({seed, 2, static_cast<std::uint64_t>(h), static_cast<std::uint64_t>(j)}));
            for (int k = 0; k < rows; ++k) x(k, j) = std::pow(prototype.uniform(), 3.0) + 0.3 * own.uniform();
            x.col(j).normalize();
        }
        matrices.push_back(x);
    }
    problem.features = matrices;
    for (int j = 0; j < columns; ++j) problem.mesh_of.push_back(j / patches);
    return problem;
}

void change_features(SubspaceProblem& problem, const std::function<void(Eigen::MatrixXd&)>& change) {
    std::vector<Eigen::MatrixXd> matrices = problem.features.matrices();
    for (Eigen::MatrixXd& feature : matrices) change(feature);
    problem.features = matrices;
}

void expect_same_coefficients(const SparseCoefficients& a, const SparseCoefficients& b) {
    EXPECT_EQ(a.size, b.size);
    EXPECT_EQ(a.columns, b.columns);
    EXPECT_EQ(a.features, b.features);
    EXPECT_EQ(a.offsets, b.offsets);
    EXPECT_EQ(a.rows, b.rows);
    EXPECT_EQ(a.values, b.values);
}

void expect_same_solution(const SolveResult& a, const SolveResult& b) {
    EXPECT_EQ(a.objective, b.objective);
    EXPECT_EQ(a.lower_bound, b.lower_bound);
    EXPECT_EQ(a.relative_gap, b.relative_gap);
    EXPECT_EQ(a.iterations, b.iterations);
    EXPECT_EQ(a.passes, b.passes);
    EXPECT_EQ(a.history, b.history);
    EXPECT_EQ(a.reason, b.reason);
    EXPECT_EQ(a.nonzero_groups, b.nonzero_groups);
    expect_same_coefficients(a.coefficients, b.coefficients);
}

std::vector<Eigen::MatrixXd> dense_weights(const SparseCoefficients& coefficients) {
    std::vector<Eigen::MatrixXd> weights(static_cast<std::size_t>(coefficients.features),
                                         Eigen::MatrixXd::Zero(coefficients.size, coefficients.size));
    for (std::int64_t j = 0; j < coefficients.columns.size(); ++j) {
        const auto c = static_cast<std::size_t>(j);
        for (std::int64_t e = coefficients.offsets[c]; e < coefficients.offsets[c + 1]; ++e) {
            for (std::size_t h = 0; h < weights.size(); ++h) {
                weights[h](coefficients.rows[static_cast<std::size_t>(e)], coefficients.columns.begin + j) =
                    coefficients.values[static_cast<std::size_t>(e) * weights.size() + h];
            }
        }
    }
    return weights;
}

namespace {

double scope_penalty(const SubspaceProblem& problem, const std::vector<Eigen::MatrixXd>& weights,
                     const Eigen::MatrixXd& pair_norms) {
    double squares = 0.0;
    if (problem.scope == PenaltyScope::rows) {
        for (const Eigen::MatrixXd& w : weights) squares += w.rowwise().sum().squaredNorm();
        return squares;
    }
    for (Eigen::Index j = 0; j < pair_norms.cols(); ++j) {
        std::map<int, double> sums;
        for (Eigen::Index i = 0; i < pair_norms.rows(); ++i) {
            sums[problem.mesh_of[static_cast<std::size_t>(i)]] += pair_norms(i, j);
        }
        for (const auto& [mesh, sum] : sums) squares += sum * sum;
    }
    return squares;
}

}  // namespace

double subspace_objective(const SubspaceProblem& problem, const std::vector<Eigen::MatrixXd>& weights) {
    double objective = 0.0;
    Eigen::MatrixXd squares = Eigen::MatrixXd::Zero(problem.size(), problem.size());
    for (std::size_t h = 0; h < weights.size(); ++h) {
        objective += (problem.features[h] * weights[h] - problem.features[h]).squaredNorm();
        objective += problem.beta * weights[h].sum();
        squares += weights[h].cwiseAbs2();
    }
    const Eigen::MatrixXd norms = squares.cwiseSqrt();
    return objective + problem.alpha * norms.sum() + problem.lambda * scope_penalty(problem, weights, norms);
}

std::filesystem::path oracle_folder() {
    const char* source = std::getenv("COSEG_SOURCE");
    const std::filesystem::path tests = source != nullptr
                                            ? std::filesystem::path(source) / "tests"
                                            : std::filesystem::path(__FILE__).parent_path().parent_path();
    return tests / "data" / "oracle";
}

}  // namespace coseg
