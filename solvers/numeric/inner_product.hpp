#pragma once
// The inner product on which the bits of the solvers' results depend.

namespace coseg {

/// Adds in four accumulators in a fixed order. It is therefore fast although the compiler may not reorder
/// sums, and it gives the same bits at any alignment. It is inlined, so that it is compiled for the vectors
/// of its callers.
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
