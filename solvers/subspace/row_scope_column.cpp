#include "solvers/subspace/row_scope_column.hpp"

#include <algorithm>
#include <cstdint>

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

/// `width` features a pair, known to the compiler; sums stay in registers.
template <std::size_t width>
void apply_stored_gram(const RowScopeColumn& fit, const double* __restrict weights,
                       double* __restrict product) {
    const std::size_t pairs = fit.rows.size();
    const double* __restrict gram = fit.gram.data();
    for (std::size_t p = 0; p < pairs; ++p) {
        double sum[width] = {};
        double own[width];
        for (std::size_t h = 0; h < width; ++h) own[h] = weights[p * width + h];
        for (std::size_t q = 0; q < p * width; q += width, gram += width) {
            for (std::size_t h = 0; h < width; ++h) {
                sum[h] += gram[h] * weights[q + h];
                product[q + h] += gram[h] * own[h];
            }
        }
        for (std::size_t h = 0; h < width; ++h) product[p * width + h] = sum[h] + gram[h] * own[h];
        gram += width;
    }
}

void apply_stored_gram(const RowScopeColumn& fit, std::size_t features, const double* weights,
                       double* product) {
    const std::size_t pairs = fit.rows.size();
    std::fill_n(product, pairs * features, 0.0);
    const double* gram = fit.gram.data();
    for (std::size_t p = 0; p < pairs; ++p) {
        double* product_p = product + p * features;
        const double* weights_p = weights + p * features;
        for (std::size_t q = 0; q < p; ++q, gram += features) {
            for (std::size_t h = 0; h < features; ++h) {
                product_p[h] += gram[h] * weights[q * features + h];
                product[q * features + h] += gram[h] * weights_p[h];
            }
        }
        for (std::size_t h = 0; h < features; ++h) product_p[h] += gram[h] * weights_p[h];
        gram += features;
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
    if (features == 5) {
        apply_stored_gram<5>(fit, weights, product);
    } else {
        apply_stored_gram(fit, features, weights, product);
    }
}

}  // namespace coseg
