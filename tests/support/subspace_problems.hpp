#pragma once
// Subspace problems made in code, and the objective written out as the formulas have it.

#include <filesystem>
#include <functional>
#include <string>

#include "solvers/subspace/coefficients.hpp"
#include "solvers/subspace/subspace_problem.hpp"
#include "solvers/variants/subspace_solver.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

/// H features of `rows` rows and N columns drawn around `parts` prototypes, columns of unit 2-norm; the
/// penalties are the struct's defaults, consecutive columns make meshes of `patches`.
SubspaceProblem random_subspace_problem(int features, int rows, int columns, int patches, std::uint64_t seed);

/// Changes every feature of a problem; those that it has been copied from keep theirs.
void change_features(SubspaceProblem& problem, const std::function<void(Eigen::MatrixXd&)>& change);

/// Coefficients of the same columns must agree to the bit.
void expect_same_coefficients(const SparseCoefficients& a, const SparseCoefficients& b);

/// Bounds, counts and coefficients must agree to the bit.
void expect_same_solution(const SolveResult& a, const SolveResult& b);

/// W_h of all columns, dense: `weights[h]` is N x N. Requires coefficients that own all columns.
std::vector<Eigen::MatrixXd> dense_weights(const SparseCoefficients& coefficients);

/// The objective of `problem.scope` by its definition, with matrices of N x N.
double subspace_objective(const SubspaceProblem& problem, const std::vector<Eigen::MatrixXd>& weights);

/// The folder of the project with problems whose optimum is known: tests/data/oracle, whose README says what
/// the files hold.
std::filesystem::path oracle_folder();

}  // namespace coseg
