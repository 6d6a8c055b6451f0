#pragma once
// The proximal steps of both scopes: group shrinkage, and the exact prox of squared sums of group norms.

#include <span>
#include <vector>

namespace coseg {

/// argmin over w >= 0 of ||w - v||^2 / 2 + step (alpha ||w||_2 + beta ||w||_1), in place of `v` (H values).
/// Returns ||w||_2, which is exactly 0 only if all of w is.
/// Source: Yuan and Lin 2006; with beta the sparse group lasso's (Simon et al. 2013): subtract, clip, scale.
double shrink_group(std::span<double> v, double step, double alpha, double beta) noexcept;

/// Scratch that exclusive_shrink reuses between calls.
struct ExclusiveShrinkScratch {
    std::vector<double> norm;
    std::vector<double> sorted;
};

/// argmin over w >= 0 of ||w - v||^2 / 2 + step (lambda (sum_i ||w_i||)^2 + alpha sum_i ||w_i|| + beta sum
/// w), in place of `v`: the pairs of one group, `features` values a pair together. Exact: norms are sorted,
/// not iterated on. Returns sum_i ||w_i||. Source: the exclusive lasso's prox (Kowalski 2009, Property 3)
/// applied to the norms of the pairs.
double exclusive_shrink(std::span<double> v, int features, double step, double alpha, double beta,
                        double lambda, ExclusiveShrinkScratch& scratch);

}  // namespace coseg
