#pragma once
// A sparse matrix stored for fast products with a vector.

#include <cstdint>
#include <vector>

#include "solvers/affinity/sparse_rows.hpp"

namespace coseg {

/// The entries of a matrix in memory.
enum class EntryPrecision {
    full,    ///< double
    single,  ///< rounded to float, which is faster where the matrix is larger than the cache
};

/// Rows of a matrix in slices of eight, whose entries alternate: first the first entry of each of the eight
/// rows, then the second of each, and so on. A product thus reads memory in one stream and adds to eight
/// sums that do not wait for each other. The rows of a slice have about the same length, because they are
/// sorted by it within windows; shorter ones are filled up with zeros.
///
/// Source: Kreutzer et al. 2014, "A unified sparse matrix data format", SELL-C-sigma with C = 8.
class SlicedRows {
  public:
    static constexpr int slice_rows = 8;
    static constexpr int window_rows = 256;

    SlicedRows() = default;
    /// Takes this rank's rows of the matrix; the columns stay as they are.
    explicit SlicedRows(SparseRows matrix, EntryPrecision precision = EntryPrecision::full);

    /// y = A x. y has one value for each row of this rank. Each is summed in double and in the order of the
    /// columns, as a plain loop over the row does it, to the same bit.
    void multiply(const double* x, double* y) const;

  private:
    void sort_windows(const SparseRows& matrix);
    template <class Value>
    void multiply_values(const Value* value, const double* x, double* y) const;

    std::vector<int> row_;  ///< at each place of the slices; -1 where the last slice has no row
    std::vector<std::int64_t> offsets_ = {0};  ///< of the slices
    std::vector<int> columns_;
    std::vector<double> values_;  ///< one of the two is empty
    std::vector<float> single_values_;
};

}  // namespace coseg
