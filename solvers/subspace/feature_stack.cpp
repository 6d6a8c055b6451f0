#include "solvers/subspace/feature_stack.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "src/base/error.hpp"
#include "src/base/index.hpp"

namespace coseg {

double FeatureStack::inner_product_error() const noexcept {
    return (dimension + 4) * std::numeric_limits<double>::epsilon();
}

namespace {

/// Neumaier's compensated sum, so that the sum over all columns is as exact as that over one.
struct CompensatedSum {
    double sum = 0.0;
    double lost = 0.0;
    void add(double value) {
        const double next = sum + value;
        lost += std::abs(sum) >= std::abs(value) ? (sum - next) + value : (value - next) + sum;
        sum = next;
    }
};

/// Plain loops: the bits must not depend on how the columns are aligned in memory.
void measure_column(FeatureStack& stack, Eigen::Index i, CompensatedSum& squared_norm) {
    const double up = 1.0 + stack.inner_product_error();
    for (int h = 0; h < stack.features; ++h) {
        const double* x = stack.feature(h) + i * stack.dimension;
        double squares = 0.0;
        double sum = 0.0;
        for (int k = 0; k < stack.rows_of(h); ++k) {
            squares += x[k] * x[k];
            sum += x[k];
        }
        squared_norm.add(squares);
        stack.largest_inner = std::max(stack.largest_inner, squares);
        stack.norm(h, i) = std::sqrt(squares) * up;
        stack.entry_sum(h, i) = sum / up;
    }
}

}  // namespace

FeatureStack::FeatureStack(FeatureMatrices given)
    : matrices(std::move(given)), columns(matrices.data(), matrices.dimension(), matrices.columns()) {
    if (columns.cols() > std::numeric_limits<int>::max()) {
        throw Error(ExitCode::input, "more than 2^31 columns; cluster fewer patches");
    }
    features = static_cast<int>(matrices.size());
    size = static_cast<int>(columns.cols());
    dimension = static_cast<int>(columns.rows());
    for (const Eigen::Index begin : matrices.offsets()) offset.push_back(static_cast<int>(begin));
    norm.resize(features, size);
    entry_sum.resize(features, size);
    CompensatedSum squares;
    for (Eigen::Index i = 0; i < size; ++i) measure_column(*this, i, squares);
    squared_norm = squares.sum + squares.lost;
}

std::vector<double> FeatureStack::largest_norms() const {
    std::vector<double> largest(at(features), 0.0);
    for (int h = 0; h < features; ++h) {
        for (Eigen::Index i = 0; i < size; ++i) largest[at(h)] = std::max(largest[at(h)], norm(h, i));
    }
    return largest;
}

FeatureStack stack_features(const SubspaceProblem& problem) { return FeatureStack(problem.features); }

FeatureStack stack_features(const Comm& comm, const SubspaceProblem& problem, std::span<const int> order) {
    const bool in_order = std::is_sorted(order.begin(), order.end());
    return FeatureStack(in_order ? problem.features : problem.features.chosen(comm, order));
}

}  // namespace coseg
