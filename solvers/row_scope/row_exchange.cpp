#include "solvers/row_scope/row_exchange.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "solvers/subspace/coefficients.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

std::vector<int> offsets_of(const std::vector<int>& counts) {
    std::vector<int> offsets(counts.size(), 0);
    std::partial_sum(counts.begin(), counts.end() - 1, offsets.begin() + 1);
    return offsets;
}

}  // namespace

RowExchange::RowExchange(const Comm& comm, std::int64_t size, int features, const std::vector<int>& rows)
    : comm_(comm),
      features_(static_cast<std::size_t>(features)),
      owned_(block_range(size, comm.size(), comm.rank(), coefficient_tile)) {
    const auto ranks = static_cast<std::size_t>(comm.size());
    std::vector<int> pairs_to(ranks, 0);
    std::vector<int> owner(rows.size());
    for (std::size_t e = 0; e < rows.size(); ++e) {
        owner[e] = block_owner(size, comm.size(), rows[e], coefficient_tile);
        ++pairs_to[at(owner[e])];
    }
    std::vector<int> next = offsets_of(pairs_to);
    std::vector<int> sent_rows(rows.size());
    send_place_.resize(rows.size());
    for (std::size_t e = 0; e < rows.size(); ++e) {
        send_place_[e] = static_cast<std::size_t>(next[at(owner[e])]++);
        sent_rows[send_place_[e]] = rows[e];
    }
    std::vector<int> pairs_from(ranks, 0);
    MPI_Alltoall(pairs_to.data(), 1, MPI_INT, pairs_from.data(), 1, MPI_INT, comm.raw());
    const auto received =
        static_cast<std::size_t>(std::accumulate(pairs_from.begin(), pairs_from.end(), std::int64_t{0}));
    agree(comm, [&] {
        if (std::max(received, rows.size()) * features_ >
            static_cast<std::size_t>(std::numeric_limits<int>::max())) {
            throw Error(ExitCode::internal, "a rank's working set exceeds 2^31 values; use more ranks");
        }
    });
    std::vector<int> received_rows(received);
    const std::vector<int> to_offsets = offsets_of(pairs_to);
    const std::vector<int> from_offsets = offsets_of(pairs_from);
    MPI_Alltoallv(sent_rows.data(), pairs_to.data(), to_offsets.data(), MPI_INT, received_rows.data(),
                  pairs_from.data(), from_offsets.data(), MPI_INT, comm.raw());
    // Ranks own ascending columns and send column by column: a stable sort by row leaves columns ascending.
    row_begin_.assign(static_cast<std::size_t>(owned_.size()) + 1, 0);
    for (const int row : received_rows) ++row_begin_[at(row - owned_.begin) + 1];
    std::partial_sum(row_begin_.begin(), row_begin_.end(), row_begin_.begin());
    std::vector<std::size_t> place(row_begin_.begin(), row_begin_.end() - 1);
    receive_place_.resize(received);
    for (std::size_t e = 0; e < received; ++e) {
        receive_place_[place[at(received_rows[e] - owned_.begin)]++] = e;
    }
    for (const int count : pairs_to) send_counts_.push_back(count * features);
    for (const int count : pairs_from) receive_counts_.push_back(count * features);
    send_.resize(rows.size() * features_);
    receive_.resize(received * features_);
}

void RowExchange::exchange(const std::vector<double>& from, const std::vector<int>& from_counts,
                           std::vector<double>& to, const std::vector<int>& to_counts) const {
    const std::vector<int> from_offsets = offsets_of(from_counts);
    const std::vector<int> to_offsets = offsets_of(to_counts);
    MPI_Alltoallv(from.data(), from_counts.data(), from_offsets.data(), MPI_DOUBLE, to.data(),
                  to_counts.data(), to_offsets.data(), MPI_DOUBLE, comm_.raw());
}

void RowExchange::to_rows(const std::vector<double>& by_column, std::vector<double>& by_row) {
    for (std::size_t e = 0; e < send_place_.size(); ++e) {
        std::copy_n(by_column.data() + e * features_, features_, send_.data() + send_place_[e] * features_);
    }
    exchange(send_, send_counts_, receive_, receive_counts_);
    by_row.resize(receive_.size());
    for (std::size_t e = 0; e < receive_place_.size(); ++e) {
        std::copy_n(receive_.data() + receive_place_[e] * features_, features_,
                    by_row.data() + e * features_);
    }
}

void RowExchange::to_columns(const std::vector<double>& by_row, std::vector<double>& by_column) {
    for (std::size_t e = 0; e < receive_place_.size(); ++e) {
        std::copy_n(by_row.data() + e * features_, features_,
                    receive_.data() + receive_place_[e] * features_);
    }
    exchange(receive_, receive_counts_, send_, send_counts_);
    by_column.resize(send_.size());
    for (std::size_t e = 0; e < send_place_.size(); ++e) {
        std::copy_n(send_.data() + send_place_[e] * features_, features_, by_column.data() + e * features_);
    }
}

}  // namespace coseg
