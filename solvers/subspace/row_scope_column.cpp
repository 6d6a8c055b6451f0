#include "solvers/subspace/row_scope_column.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "solvers/numeric/inner_product.hpp"
#include "src/base/index.hpp"
#include "src/base/vector_clones.hpp"

namespace coseg {

namespace {

/// Above this many pairs a column's Gram matrices take more memory, and in time as much, as products with X.
constexpr std::size_t largest_gram = 160;

const double* column_of(const FeatureStack& stack, int i) {
    return stack.columns.data() + static_cast<std::int64_t>(i) * stack.dimension;
}

/// At most so many features are done at a time, so that their sums stay in registers.
constexpr std::size_t most_features_at_a_time = 8;

/// product = (stored Gram matrices) weights for the features first .. first + width of the `features` that a
/// pair has.
using ApplyGram = void (*)(const RowScopeColumn& fit, std::size_t features, std::size_t first,
                           const double* weights, double* product);

/// The number of features done at a time is known to the compiler; `all`: a pair has no others.
template <std::size_t width, bool all>
void apply_stored_gram(const RowScopeColumn& fit, std::size_t features, std::size_t first,
                       const double* __restrict weights, double* __restrict product) {
    const std::size_t pairs = fit.rows.size();
    const std::size_t stride = all ? width : features;
    const double* __restrict gram = fit.gram.data() + first;
    weights += first;
    product += first;
    for (std::size_t p = 0; p < pairs; ++p) {
        double sum[width] = {};
        double own[width];
        for (std::size_t h = 0; h < width; ++h) own[h] = weights[p * stride + h];
        for (std::size_t q = 0; q < p * stride; q += stride, gram += stride) {
            for (std::size_t h = 0; h < width; ++h) {
                sum[h] += gram[h] * weights[q + h];
                product[q + h] += gram[h] * own[h];
            }
        }
        for (std::size_t h = 0; h < width; ++h) product[p * stride + h] = sum[h] + gram[h] * own[h];
        gram += stride;
    }
}

/// One for each width from 1 on.
template <bool all, std::size_t... less_one>
constexpr std::array<ApplyGram, sizeof...(less_one)> of_all_widths(std::index_sequence<less_one...>) {
    return {&apply_stored_gram<less_one + 1, all>...};
}

void apply_stored_gram(const RowScopeColumn& fit, std::size_t features, const double* weights,
                       double* product) {
    using Widths = std::make_index_sequence<most_features_at_a_time>;
    static constexpr auto all_of_a_pair = of_all_widths<true>(Widths());
    static constexpr auto some_of_a_pair = of_all_widths<false>(Widths());
    if (features <= most_features_at_a_time) {
        all_of_a_pair[features - 1](fit, features, 0, weights, product);
        return;
    }
    for (std::size_t first = 0; first < features; first += most_features_at_a_time) {
        const std::size_t width = std::min(features - first, most_features_at_a_time);
        some_of_a_pair[width - 1](fit, features, first, weights, product);
    }
}

}  // namespace

COSEG_VECTOR_CLONES
void feature_products(const FeatureStack& stack, int row, const double* y, double* products) {
    const double* x = column_of(stack, row);
    for (std::size_t h = 0; h < at(stack.features); ++h) {
        const int begin = stack.offset[h];
        products[h] = inner_product(x + begin, y + begin, stack.offset[h + 1] - begin);
    }
}

void prepare_row_scope_column(const FeatureStack& stack, int column, RowScopeColumn& fit) {
    const auto features = at(stack.features);
    const std::size_t pairs = fit.rows.size();
    fit.linear.resize(pairs * features);
    for (std::size_t p = 0; p < pairs; ++p) {
        feature_products(stack, fit.rows[p], column_of(stack, column), fit.linear.data() + p * features);
    }
    fit.gram.clear();
    fit.gram.shrink_to_fit();
    if (pairs > largest_gram) return;
    fit.gram.resize(pairs * (pairs + 1) / 2 * features);
    double* gram = fit.gram.data();
    for (std::size_t p = 0; p < pairs; ++p) {
        for (std::size_t q = 0; q <= p; ++q, gram += features) {
            feature_products(stack, fit.rows[p], column_of(stack, fit.rows[q]), gram);
        }
    }
}

COSEG_VECTOR_CLONES
void reconstruct(const FeatureStack& stack, const RowScopeColumn& fit, const double* weights,
                 double* reconstruction) {
    std::fill_n(reconstruction, stack.dimension, 0.0);
    const auto features = at(stack.features);
    for (std::size_t p = 0; p < fit.rows.size(); ++p) {
        const double* x = column_of(stack, fit.rows[p]);
        for (std::size_t h = 0; h < features; ++h) {
            const double weight = weights[p * features + h];
            if (weight == 0.0) continue;
            for (int k = stack.offset[h]; k < stack.offset[h + 1]; ++k) reconstruction[k] += weight * x[k];
        }
    }
}

void apply_gram(const FeatureStack& stack, const RowScopeColumn& fit, const double* weights,
                double* product) {
    const auto features = at(stack.features);
    const std::size_t pairs = fit.rows.size();
    if (fit.gram.empty()) {
        std::vector<double> reconstruction(at(stack.dimension));
        reconstruct(stack, fit, weights, reconstruction.data());
        for (std::size_t p = 0; p < pairs; ++p) {
            feature_products(stack, fit.rows[p], reconstruction.data(), product + p * features);
        }
        return;
    }
    apply_stored_gram(fit, features, weights, product);
}

}  // namespace coseg
