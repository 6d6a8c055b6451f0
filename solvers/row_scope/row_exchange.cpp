#include "solvers/row_scope/row_exchange.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "solvers/subspace/coefficients.hpp"
#include "src/base/index.hpp"

namespace coseg {

RowExchange::RowExchange(const Comm& comm, std::int64_t size, int features, const std::vector<int>& rows)
    : comm_(comm),
      features_(at(features)),
      owned_(block_range(size, comm.size(), comm.rank(), coefficient_tile)) {
    std::vector<std::int64_t> outgoing(at(comm.size()), 0);
    std::vector<int> owner(rows.size());
    for (std::size_t e = 0; e < rows.size(); ++e) {
        owner[e] = block_owner(size, comm.size(), rows[e], coefficient_tile);
        ++outgoing[at(owner[e])];
    }
    to_rows_ = owner_counts(comm, std::move(outgoing), "pairs of its working set");
    to_columns_ = {to_rows_.incoming, to_rows_.outgoing};

    std::vector<std::int64_t> next(to_rows_.outgoing.size());
    std::exclusive_scan(to_rows_.outgoing.begin(), to_rows_.outgoing.end(), next.begin(), std::int64_t{0});
    std::vector<int> sent_rows(rows.size());
    send_place_.resize(rows.size());
    for (std::size_t e = 0; e < rows.size(); ++e) {
        send_place_[e] = at(next[at(owner[e])]++);
        sent_rows[send_place_[e]] = rows[e];
    }
    std::vector<int> received(
        at(std::accumulate(to_rows_.incoming.begin(), to_rows_.incoming.end(), std::int64_t{0})));
    exchange_packed(comm, to_rows_, sizeof(int), sent_rows.data(), received.data());
    plan_rows(received);
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

void RowExchange::to_rows(const std::vector<double>& by_column, std::vector<double>& by_row) {
    for (std::size_t e = 0; e < send_place_.size(); ++e) {
        std::copy_n(by_column.data() + e * features_, features_, send_.data() + send_place_[e] * features_);
    }
    exchange_packed(comm_, to_rows_, features_ * sizeof(double), send_.data(), receive_.data());
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
    exchange_packed(comm_, to_columns_, features_ * sizeof(double), receive_.data(), send_.data());
    by_column.resize(send_.size());
    for (std::size_t e = 0; e < send_place_.size(); ++e) {
        std::copy_n(send_.data() + send_place_[e] * features_, features_, by_column.data() + e * features_);
    }
}

}  // namespace coseg
