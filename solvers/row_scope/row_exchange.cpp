#include "solvers/row_scope/row_exchange.hpp"

#include <algorithm>
#include <numeric>

#include "solvers/subspace/coefficients.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

template <class Count>
std::vector<Count> offsets_of(const std::vector<Count>& counts) {
    std::vector<Count> offsets(counts.size(), 0);
    std::partial_sum(counts.begin(), counts.end() - 1, offsets.begin() + 1);
    return offsets;
}

std::int64_t sum_of(const std::vector<std::int64_t>& counts) {
    return std::accumulate(counts.begin(), counts.end(), std::int64_t{0});
}

/// As MPI counts; `factor` values each.
std::vector<int> message_counts(const std::vector<std::int64_t>& counts, std::int64_t factor) {
    std::vector<int> values;
    for (const std::int64_t count : counts) values.push_back(static_cast<int>(count * factor));
    return values;
}

std::vector<std::int64_t> swapped_counts(const Comm& comm, const std::vector<std::int64_t>& to) {
    std::vector<std::int64_t> from(to.size(), 0);
    MPI_Alltoall(to.data(), 1, MPI_INT64_T, from.data(), 1, MPI_INT64_T, comm.raw());
    return from;
}

/// The rows that this rank owns, from the owners of the columns.
std::vector<int> received_rows(const Comm& comm, const std::vector<int>& sent, const std::vector<int>& to,
                               const std::vector<int>& from) {
    const std::vector<int> to_offsets = offsets_of(to);
    const std::vector<int> from_offsets = offsets_of(from);
    std::vector<int> received(at(from_offsets.back() + from.back()));
    MPI_Alltoallv(sent.data(), to.data(), to_offsets.data(), MPI_INT, received.data(), from.data(),
                  from_offsets.data(), MPI_INT, comm.raw());
    return received;
}

}  // namespace

void refuse_long_exchange(std::int64_t pairs, std::int64_t features) {
    if (pairs * features > longest_message)
        throw Error(ExitCode::internal, "a rank's working set exceeds 2^31 values; use more ranks");
}

RowExchange::RowExchange(const Comm& comm, std::int64_t size, int features, const std::vector<int>& rows)
    : comm_(comm),
      features_(at(features)),
      owned_(block_range(size, comm.size(), comm.rank(), coefficient_tile)) {
    std::vector<std::int64_t> pairs_to(at(comm.size()), 0);
    std::vector<int> owner(rows.size());
    for (std::size_t e = 0; e < rows.size(); ++e) {
        owner[e] = block_owner(size, comm.size(), rows[e], coefficient_tile);
        ++pairs_to[at(owner[e])];
    }
    const std::vector<std::int64_t> pairs_from = swapped_counts(comm, pairs_to);
    agree(comm, [&] { refuse_long_exchange(std::max(sum_of(pairs_to), sum_of(pairs_from)), features); });
    send_counts_ = message_counts(pairs_to, features);
    receive_counts_ = message_counts(pairs_from, features);

    std::vector<std::int64_t> next = offsets_of(pairs_to);
    std::vector<int> sent_rows(rows.size());
    send_place_.resize(rows.size());
    for (std::size_t e = 0; e < rows.size(); ++e) {
        send_place_[e] = at(next[at(owner[e])]++);
        sent_rows[send_place_[e]] = rows[e];
    }
    plan_rows(received_rows(comm, sent_rows, message_counts(pairs_to, 1), message_counts(pairs_from, 1)));
    send_.resize(rows.size() * features_);
    receive_.resize(receive_place_.size() * features_);
}

/// Ranks own ascending columns and send column by column: a stable sort by row leaves columns ascending.
void RowExchange::plan_rows(const std::vector<int>& received) {
    row_begin_.assign(at(owned_.size()) + 1, 0);
    for (const int row : received) ++row_begin_[at(row - owned_.begin) + 1];
    std::partial_sum(row_begin_.begin(), row_begin_.end(), row_begin_.begin());
    std::vector<std::size_t> place(row_begin_.begin(), row_begin_.end() - 1);
    receive_place_.resize(received.size());
    for (std::size_t e = 0; e < received.size(); ++e)
        receive_place_[place[at(received[e] - owned_.begin)]++] = e;
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
