#pragma once
// The inner product that the solvers' bits rest on.

namespace coseg {

/// Four accumulators in a fixed order: fast without leave to reorder, and the same bits at any alignment. Inlined for
/// the callers' vectors.
__attribute__((always_inline)) inline double inner_product(const double* x, const double* y, int n) noexcept {
    double sum[4] = {0.0, 0.0, 0.0, 0.0};
    int k = 0;
    for (; k + 4 <= n; k += 4) {
        for (int l = 0; l < 4; ++l) sum[l] += x[k + l] * y[k + l];
    }
    for (; k < n; ++k) sum[0] += x[k] * y[k];
    return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

}  // namespace coseg
