#pragma once
// Sums and combinations of long columns, tile by tile.
//
// A column is cut into tiles of row_tile rows, and ranks own whole tiles. Each tile is worked on alone and in
// the same way wherever it lies in memory. What a tile gives has therefore the same bits on any number of
// ranks; BLAS does not promise this, as it treats the ends of a column in another way than its middle.

#include <cstdint>
#include <span>

#include "src/parallel/exact_sum.hpp"

namespace coseg {

/// Adds sum_i x_i y_ji to scalar j of `sums`, for each column y_j, all of `length` rows.
void add_products(std::span<const double* const> y, const double* x, std::int64_t length, ExactSum& sums);

/// y += sum_j weights_j x_j, added in the order of j. y is none of the x_j.
void add_multiples(std::span<const double* const> x, const double* weights, double* y, std::int64_t length);

/// A dense matrix in column order, as PETSc and LAPACK keep it.
struct ColumnMajor {
    const double* values = nullptr;
    std::int64_t stride = 0;  ///< from column to column
};

/// Column c of `results` becomes sum_j x_j q(j, c), in the order of j. A result may be one of the x_j.
void combine_columns(std::span<const double* const> x, ColumnMajor q, std::span<double* const> results,
                     std::int64_t length);

}  // namespace coseg
