#pragma once
// A square sparse matrix owned by rows: the form in which affinities are built, before PETSc sees them.
//
// Every sum over the matrix is taken row by row in the order of columns, and over rows in global order, so
// that it has the same bits on any number of ranks. A matrix that every rank holds whole goes with a
// communicator of one rank.

#include <cstdint>
#include <span>
#include <vector>

#include "src/parallel/block_range.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

/// Rows are owned as block_range(size, ranks, rank, row_tile).
inline constexpr std::int64_t row_tile = 32;

struct SparseEntry {
    int row = 0;
    int column = 0;
    double value = 0.0;
};

struct SparseRows {
    std::int64_t size = 0;  ///< rows and columns of the whole matrix
    BlockRange rows;        ///< the rows of this rank
    /// rows.size() + 1; row rows.begin + r holds offsets[r] .. offsets[r+1].
    std::vector<std::int64_t> offsets = {0};
    std::vector<int> columns;  ///< ascending within a row
    std::vector<double> values;

    [[nodiscard]] std::int64_t local_rows() const noexcept { return rows.size(); }
};

/// Rows of a matrix where they lie; whoever holds them must outlive this. The fields are those of SparseRows.
struct SparseRowsView {
    /// Implicit, as for a reader the two are the same.
    SparseRowsView(const SparseRows& matrix)  // NOLINT(google-explicit-constructor)
        : SparseRowsView(matrix.size, matrix.rows, matrix.offsets, matrix.columns, matrix.values) {}
    SparseRowsView(std::int64_t of_size, BlockRange of_rows, std::span<const std::int64_t> ends,
                   std::span<const int> places, std::span<const double> entries)
        : size(of_size), rows(of_rows), offsets(ends), columns(places), values(entries) {}

    std::int64_t size;
    BlockRange rows;
    std::span<const std::int64_t> offsets;
    std::span<const int> columns;
    std::span<const double> values;

    [[nodiscard]] std::int64_t local_rows() const noexcept { return rows.size(); }
};

/// The rows `range` of a matrix, made of entries of these rows in any order. Entries of the same row and
/// column are added, smallest first, so that their order does not matter.
SparseRows rows_from_entries(std::int64_t size, BlockRange range, std::vector<SparseEntry> entries);

/// The same, made of entries of any row on any rank: each entry is sent to the owner of its row. Collective.
SparseRows exchange_entries(const Comm& comm, std::int64_t size, std::vector<SparseEntry> entries);

/// All rows on every rank. Collective.
SparseRows gather_rows(const Comm& comm, const SparseRows& local);

/// sum_j S_ij of this rank's rows.
std::vector<double> row_sums(const SparseRows& matrix);

/// sum_j S_ij of all rows, on all ranks. Collective.
std::vector<double> row_sums_global(const Comm& comm, const SparseRows& matrix);

/// The sum of all entries, added in the order of rows. Collective.
double total(const Comm& comm, const SparseRows& matrix);

struct WeightedMatrix {
    SparseRowsView matrix;
    double weight = 1.0;
};

/// The sum of weight * matrix over matrices that own the same rows. Those of weight 0 are left out.
SparseRows weighted_sum(std::span<const WeightedMatrix> terms);

/// Drops entries smaller than `threshold`.
void drop_small_entries(SparseRows& matrix, double threshold);

}  // namespace coseg
