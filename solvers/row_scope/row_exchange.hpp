#pragma once
// Moves the values of W's pairs between the owners of their columns and the owners of their rows.

#include <cstdint>
#include <span>
#include <vector>

#include "src/base/index.hpp"
#include "src/parallel/block_range.hpp"
#include "src/parallel/comm.hpp"
#include "src/parallel/owner_exchange.hpp"

namespace coseg {

/// The plan of the exchange for one sparsity pattern. Rows are owned like columns: block_range(N, ranks,
/// rank, coefficient_tile).
class RowExchange {
  public:
    /// `rows` of the pairs of this rank's columns, column by column; `features` values a pair. Collective.
    /// Throws AgreedError(internal) where a rank sends or gets more than 2^31 pairs.
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

    const Comm& comm_;
    std::size_t features_;
    BlockRange owned_;
    std::vector<std::size_t> send_place_;     ///< of each pair by columns: its place in the send buffer
    std::vector<std::size_t> receive_place_;  ///< of each pair by rows: its place in the receive buffer
    std::vector<std::size_t> row_begin_;
    OwnerCounts to_rows_;  ///< pairs that go to and come from each rank
    OwnerCounts to_columns_;
    std::vector<double> send_;
    std::vector<double> receive_;
};

}  // namespace coseg
