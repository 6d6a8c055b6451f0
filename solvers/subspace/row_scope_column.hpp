#pragma once
// The least-squares part of one column on its working set of pairs.

#include <vector>

#include "solvers/subspace/feature_stack.hpp"

namespace coseg {

/// The working set of column j of row scope, the H values of a pair together.
struct RowScopeColumn {
    std::vector<int> rows;        ///< ascending, never j itself
    std::vector<double> weights;  ///< W
    std::vector<double> linear;   ///< x_hi . x_hj
    /// x_hi . x_hk for the pairs k <= i of the working set: row by row of the lower triangle, H values
    /// together. It is empty where the working set is so large that products with the features themselves are
    /// cheaper.
    std::vector<double> gram;
};

/// Fills in `linear` and `gram` for the rows of `fit`, the working set of column `column`.
void prepare_row_scope_column(const FeatureStack& stack, int column, RowScopeColumn& fit);

/// product = X_S^T X_S weights, per feature, which the gradient of the fit needs. `weights` and `product`
/// hold rows.size() x H values.
void apply_gram(const FeatureStack& stack, const RowScopeColumn& fit, const double* weights, double* product);

/// z = X w, D values.
void reconstruct(const FeatureStack& stack, const RowScopeColumn& fit, const double* weights,
                 double* reconstruction);

/// x_hi . y_h for all h: D values of y, H results.
void feature_products(const FeatureStack& stack, int row, const double* y, double* products);

}  // namespace coseg
