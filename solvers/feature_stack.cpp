#include "solvers/feature_stack.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/error.hpp"

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

FeatureStack stack_features(const SubspaceProblem& problem, std::span<const int> order) {
    if (problem.size() > std::numeric_limits<int>::max()) {
        throw Error(ExitCode::input, "more than 2^31 columns; cluster fewer patches");
    }
    FeatureStack stack;
    stack.features = problem.feature_count();
    stack.size = static_cast<int>(problem.size());
    stack.offset.assign(1, 0);
    for (const Eigen::MatrixXd& feature : problem.features) {
        stack.offset.push_back(stack.offset.back() + static_cast<int>(feature.rows()));
    }
    stack.dimension = stack.offset.back();
    stack.columns.resize(stack.dimension, stack.size);
    stack.norm.resize(stack.features, stack.size);
    stack.entry_sum.resize(stack.features, stack.size);
    CompensatedSum squared_norm;
    for (Eigen::Index i = 0; i < stack.size; ++i) {
        const Eigen::Index from = order.empty() ? i : order[static_cast<std::size_t>(i)];
        for (int h = 0; h < stack.features; ++h) {
            const Eigen::MatrixXd& feature = problem.features[static_cast<std::size_t>(h)];
            std::copy_n(
                feature.data() + from * feature.rows(), feature.rows(),
                stack.columns.data() + i * stack.dimension + stack.offset[static_cast<std::size_t>(h)]);
        }
        measure_column(stack, i, squared_norm);
    }
    stack.squared_norm = squared_norm.sum + squared_norm.lost;
    return stack;
}

}  // namespace coseg
