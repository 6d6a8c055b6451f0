#pragma once
// Moves the values of W's pairs between the owners of their columns and the owners of their rows.

#include <cstdint>
#include <span>
#include <vector>

#include "src/base/index.hpp"
#include "src/parallel/block_range.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

/// Throws Error(internal) if `pairs` of `features` values each are more than a rank can send or receive at
/// once.
void refuse_long_exchange(std::int64_t pairs, std::int64_t features);

/// The plan of the exchange for one sparsity pattern. Rows are owned like columns: block_range(N, ranks,
/// rank, coefficient_tile).
class RowExchange {
  public:
    /// `rows` of the pairs of this rank's columns, column by column; `features` values a pair. Collective.
    RowExchange(const Comm& comm, std::int64_t size, int features, const std::vector<int>& rows);

    [[nodiscard]] BlockRange owned_rows() const noexcept { return owned_; }
    /// The values of owned row r (counted from owned_rows().begin) in the result of to_rows: H for each pair,
    /// ascending in their columns.
    [[nodiscard]] std::span<double> row(std::vector<double>& by_row, std::int64_t r) const {
        const std::size_t begin = row_begin_[at(r)] * features_;
        const std::size_t end = row_begin_[at(r) + 1] * features_;
        return std::span(by_row).subspan(begin, end - begin);
    }

    /// Moves values that are ordered by columns into the order by rows, and back. Collective.
    void to_rows(const std::vector<double>& by_column, std::vector<double>& by_row);
    void to_columns(const std::vector<double>& by_row, std::vector<double>& by_column);

  private:
    void plan_rows(const std::vector<int>& received);
    void exchange(const std::vector<double>& from, const std::vector<int>& from_counts,
                  std::vector<double>& to, const std::vector<int>& to_counts) const;

    const Comm& comm_;
    std::size_t features_;
    BlockRange owned_;
    std::vector<std::size_t> send_place_;     ///< of each pair by columns: its place in the send buffer
    std::vector<std::size_t> receive_place_;  ///< of each pair by rows: its place in the receive buffer
    std::vector<std::size_t> row_begin_;
    std::vector<int> send_counts_;     ///< values per rank
    std::vector<int> receive_counts_;  ///< values per rank
    std::vector<double> send_;
    std::vector<double> receive_;
};

}  // namespace coseg
