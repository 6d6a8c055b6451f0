#include "solvers/subspace/subspace_problem.hpp"

#include <algorithm>
#include <cmath>

#include "src/base/error.hpp"
#include "src/base/index.hpp"

namespace coseg {

double gap_scale(PenaltyScope scope, double objective, double objective_at_zero) {
    return scope == PenaltyScope::meshes ? objective_at_zero - objective
                                         : std::max(objective, 1e-6 * objective_at_zero);
}

namespace {

std::string place(std::size_t feature, Eigen::Index column) {
    return "feature " + std::to_string(feature + 1) + ", column " + std::to_string(column + 1);
}

void validate_column(const FeatureMatrices::ConstBlock& feature, std::size_t h, Eigen::Index j) {
    double sum = 0.0;
    for (Eigen::Index k = 0; k < feature.rows(); ++k) {
        const double value = feature(k, j);
        if (!std::isfinite(value)) {
            throw Error(ExitCode::input, place(h, j) +
                                             " holds a value that is not a finite number; every entry "
                                             "must be finite and at least 0");
        }
        if (value < 0.0) {
            throw Error(ExitCode::input, place(h, j) + " holds the negative value " + std::to_string(value) +
                                             "; every entry must be at least 0");
        }
        sum += value * value;
    }
    if (!(sum > 0.0)) {
        throw Error(ExitCode::input,
                    place(h, j) + " is all zeros (or too small to square); leave that column out");
    }
    if (!std::isfinite(sum)) {
        throw Error(ExitCode::input, place(h, j) + " is too large to square; scale the feature down");
    }
}

void validate_penalty(double value, const char* name) {
    if (std::isfinite(value) && value >= 0.0) return;
    throw Error(ExitCode::input, std::string(name) + " must be a finite number of at least 0");
}

void validate_meshes(const SubspaceProblem& problem) {
    if (static_cast<std::int64_t>(problem.mesh_of.size()) != problem.size()) {
        throw Error(ExitCode::input, "mesh scope needs the mesh of each of the " +
                                         std::to_string(problem.size()) + " columns, but " +
                                         std::to_string(problem.mesh_of.size()) + " were given");
    }
    const int least = *std::min_element(problem.mesh_of.begin(), problem.mesh_of.end());
    const int largest = *std::max_element(problem.mesh_of.begin(), problem.mesh_of.end());
    if (least < 0) throw Error(ExitCode::input, "a column's mesh is negative; meshes count from 0");
    if (!problem.allowed_meshes.empty() && static_cast<int>(problem.allowed_meshes.size()) <= largest) {
        throw Error(ExitCode::input, "the allowed meshes are given for " +
                                         std::to_string(problem.allowed_meshes.size()) +
                                         " meshes, but mesh " + std::to_string(largest) + " occurs");
    }
    for (const std::vector<int>& allowed : problem.allowed_meshes) {
        if (!std::is_sorted(allowed.begin(), allowed.end())) {
            throw Error(ExitCode::input, "the allowed meshes of a mesh are not in ascending order");
        }
    }
}

}  // namespace

std::int64_t allowed_pair_count(const SubspaceProblem& problem) {
    const std::int64_t n = problem.size();
    if (problem.scope == PenaltyScope::rows) return n * (n - 1);
    const int meshes = 1 + *std::max_element(problem.mesh_of.begin(), problem.mesh_of.end());
    std::vector<std::int64_t> patches(at(meshes), 0);
    for (const int mesh : problem.mesh_of) ++patches[at(mesh)];
    std::int64_t pairs = 0;
    for (std::size_t m = 0; m < patches.size(); ++m) {
        std::int64_t rows = problem.allowed_meshes.empty() ? n - patches[m] : 0;
        if (!problem.allowed_meshes.empty()) {
            for (const int other : problem.allowed_meshes[m]) {
                const auto o = at(other);
                if (o != m && o < patches.size()) rows += patches[o];
            }
        }
        pairs += rows * patches[m];
    }
    return pairs;
}

void validate(const SubspaceProblem& problem) {
    if (problem.features.empty())
        throw Error(ExitCode::input, "the problem has no feature; give at least one");
    if (problem.size() == 0) throw Error(ExitCode::input, "the problem has no columns; give at least one");
    for (std::size_t h = 0; h < problem.features.size(); ++h) {
        const FeatureMatrices::ConstBlock feature = problem.features[h];
        for (Eigen::Index j = 0; j < feature.cols(); ++j) validate_column(feature, h, j);
    }
    validate_penalty(problem.alpha, "alpha");
    validate_penalty(problem.beta, "beta");
    validate_penalty(problem.lambda, "lambda");
    if (problem.scope == PenaltyScope::meshes) validate_meshes(problem);
}

}  // namespace coseg
