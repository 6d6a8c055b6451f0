#include "solvers/subspace/solve_history.hpp"

#include <algorithm>

#include "src/parallel/exact_sum.hpp"

namespace coseg {

namespace {

template <class Row>
std::size_t longest(const std::vector<std::vector<Row>>& all) {
    std::size_t length = 0;
    for (const std::vector<Row>& rows : all) length = std::max(length, rows.size());
    return length;
}

template <class Row>
const Row& row_or_last(const std::vector<Row>& rows, std::size_t k) {
    return rows[std::min(k, rows.size() - 1)];
}

}  // namespace

void append_row(SolveHistory& history, const HistoryRow& row) {
    if (history.size() >= most_history_rows) {
        for (std::size_t k = 0; 2 * k < history.size(); ++k) history[k] = history[2 * k];
        history.resize((history.size() + 1) / 2);
    }
    history.push_back(row);
}

SolveHistory joined(const std::vector<SolveHistory>& histories) {
    SolveHistory all(longest(histories));
    for (std::size_t k = 0; k < all.size(); ++k) {
        for (const SolveHistory& history : histories) {
            if (history.empty()) continue;
            const HistoryRow& row = row_or_last(history, k);
            all[k].pass = std::max(all[k].pass, row.pass);
            all[k].iterations = std::max(all[k].iterations, row.iterations);
            all[k].objective += row.objective;
            all[k].lower_bound += row.lower_bound;
            all[k].relative_gap = std::max(all[k].relative_gap, row.relative_gap);
            all[k].working_pairs += row.working_pairs;
        }
    }
    return all;
}

void append_round(std::vector<ColumnRound>& rounds, const ColumnRound& round) {
    if (rounds.size() >= most_history_rows) rounds.pop_back();
    rounds.push_back(round);
}

std::vector<ColumnRound> joined_rounds(const std::vector<std::vector<ColumnRound>>& columns) {
    std::vector<ColumnRound> all(longest(columns));
    for (std::size_t k = 0; k < all.size(); ++k) {
        for (const std::vector<ColumnRound>& rounds : columns) {
            if (rounds.empty()) continue;
            const ColumnRound& round = row_or_last(rounds, k);
            all[k].reached += round.reached;
            all[k].bound += round.bound;
            all[k].iterations = std::max(all[k].iterations, round.iterations);
            all[k].working_pairs += round.working_pairs;
        }
    }
    return all;
}

std::vector<ColumnRound> joined_rounds(const Comm& comm, const std::vector<std::vector<ColumnRound>>& tiles) {
    const auto count = at(all_max(comm, static_cast<std::int64_t>(longest(tiles))));
    std::vector<ColumnRound> all = joined_rounds(tiles);
    all.resize(count, all.empty() ? ColumnRound{} : all.back());
    ExactSum sums(2 * count);
    std::vector<int> iterations(count, 0);
    std::vector<std::int64_t> pairs(count, 0);
    for (std::size_t k = 0; k < count; ++k) {
        for (const std::vector<ColumnRound>& rounds : tiles) {
            if (rounds.empty()) continue;
            sums.add_scalar(2 * k, row_or_last(rounds, k).reached);
            sums.add_scalar(2 * k + 1, row_or_last(rounds, k).bound);
        }
        iterations[k] = all[k].iterations;
        pairs[k] = all[k].working_pairs;
    }
    sums.reduce(comm);
    MPI_Allreduce(MPI_IN_PLACE, iterations.data(), static_cast<int>(count), MPI_INT, MPI_MAX, comm.raw());
    MPI_Allreduce(MPI_IN_PLACE, pairs.data(), static_cast<int>(count), MPI_INT64_T, MPI_SUM, comm.raw());
    for (std::size_t k = 0; k < count; ++k)
        all[k] = {sums.scalar(2 * k), sums.scalar(2 * k + 1), iterations[k], pairs[k]};
    return all;
}

}  // namespace coseg
