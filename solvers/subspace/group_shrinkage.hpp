#pragma once
// The proximal steps of both scopes: group shrinkage, and the exact proximal map of squared sums of group
// norms.

#include <span>
#include <vector>

namespace coseg {

/// Replaces `v` (H values) by the argmin over w >= 0 of ||w - v||^2 / 2 + step (alpha ||w||_2 + beta
/// ||w||_1). Returns ||w||_2, which is exactly 0 only if all of w is. Source: Yuan and Lin 2006; with beta it
/// is the prox of the sparse group lasso (Simon et al. 2013): subtract, clip, scale.
double shrink_group(std::span<double> v, double step, double alpha, double beta) noexcept;

/// The penalties of a column's problem.
struct ColumnPenalties {
    double alpha = 0.0;
    double beta = 0.0;
    double lambda = 0.0;
};

/// Memory that exclusive_shrink uses again in each call.
struct ExclusiveShrinkScratch {
    std::vector<double> norm;
    std::vector<double> sorted;
};

/// Replaces `v` by the argmin over w >= 0 of ||w - v||^2 / 2 + step (lambda (sum_i ||w_i||)^2 + alpha sum_i
/// ||w_i|| + beta sum w). `v` holds the pairs of one group, `features` values of a pair together. The result
/// is exact: norms are sorted, not iterated on. Returns sum_i ||w_i||. Source: the prox of the exclusive
/// lasso (Kowalski 2009, Property 3), applied to the norms of the pairs.
double exclusive_shrink(std::span<double> v, int features, double step, const ColumnPenalties& penalties,
                        ExclusiveShrinkScratch& scratch);

}  // namespace coseg
