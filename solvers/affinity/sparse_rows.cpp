#include "solvers/affinity/sparse_rows.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

#include "src/base/index.hpp"
#include "src/parallel/owner_exchange.hpp"

namespace coseg {

namespace {

/// Counting sort by row, then each row by column and value.
std::vector<std::int64_t> sort_by_row(BlockRange range, std::vector<SparseEntry>& entries) {
    std::vector<std::int64_t> starts(at(range.size()) + 1, 0);
    for (const SparseEntry& e : entries) ++starts[at(e.row - range.begin) + 1];
    std::partial_sum(starts.begin(), starts.end(), starts.begin());
    std::vector<std::int64_t> next(starts.begin(), starts.end() - 1);
    std::vector<SparseEntry> sorted(entries.size());
    for (const SparseEntry& e : entries) {
        sorted[at(next[at(e.row - range.begin)]++)] = e;
    }
    entries = std::move(sorted);
    const auto before = [](const SparseEntry& a, const SparseEntry& b) {
        return std::tie(a.column, a.value) < std::tie(b.column, b.value);
    };
    for (std::size_t r = 0; r + 1 < starts.size(); ++r) {
        std::sort(entries.begin() + starts[r], entries.begin() + starts[r + 1], before);
    }
    return starts;
}

}  // namespace

SparseRows rows_from_entries(std::int64_t size, BlockRange range, std::vector<SparseEntry> entries) {
    const std::vector<std::int64_t> starts = sort_by_row(range, entries);
    SparseRows matrix;
    matrix.size = size;
    matrix.rows = range;
    matrix.offsets.assign(1, 0);
    matrix.columns.reserve(entries.size());  // at most: memory that is not written to is not taken
    matrix.values.reserve(entries.size());
    for (std::size_t r = 0; r + 1 < starts.size(); ++r) {
        const auto row_begin = at(matrix.offsets.back());
        for (auto k = at(starts[r]); k < at(starts[r + 1]); ++k) {
            if (matrix.columns.size() > row_begin && matrix.columns.back() == entries[k].column) {
                matrix.values.back() += entries[k].value;
            } else {
                matrix.columns.push_back(entries[k].column);
                matrix.values.push_back(entries[k].value);
            }
        }
        matrix.offsets.push_back(static_cast<std::int64_t>(matrix.columns.size()));
    }
    return matrix;
}

SparseRows exchange_entries(const Comm& comm, std::int64_t size, std::vector<SparseEntry> entries) {
    std::vector<SparseEntry> mine = sent_to_owners(
        comm, std::move(entries),
        [&](const SparseEntry& e) { return block_owner(size, comm.size(), e.row, row_tile); }, "affinities");
    return rows_from_entries(size, block_range(size, comm.size(), comm.rank(), row_tile), std::move(mine));
}

SparseRows gather_rows(const Comm& comm, const SparseRows& local) {
    if (comm.size() == 1) return local;
    std::vector<std::int64_t> lengths(at(local.local_rows()));
    for (std::size_t r = 0; r < lengths.size(); ++r) lengths[r] = local.offsets[r + 1] - local.offsets[r];
    SparseRows all;
    all.size = local.size;
    all.rows = {0, local.size};
    const std::vector<std::int64_t> all_lengths = all_gather(comm, std::span<const std::int64_t>(lengths));
    all.offsets.assign(all_lengths.size() + 1, 0);
    std::partial_sum(all_lengths.begin(), all_lengths.end(), all.offsets.begin() + 1);
    all.columns = all_gather(comm, std::span<const int>(local.columns));
    all.values = all_gather(comm, std::span<const double>(local.values));
    return all;
}

std::vector<double> row_sums(const SparseRows& matrix) {
    std::vector<double> sums(at(matrix.local_rows()), 0.0);
    for (std::size_t r = 0; r < sums.size(); ++r) {
        for (auto k = matrix.offsets[r]; k < matrix.offsets[r + 1]; ++k) {
            sums[r] += matrix.values[at(k)];
        }
    }
    return sums;
}

std::vector<double> row_sums_global(const Comm& comm, const SparseRows& matrix) {
    const std::vector<double> local = row_sums(matrix);
    return comm.size() == 1 ? local : all_gather(comm, std::span<const double>(local));
}

double total(const Comm& comm, const SparseRows& matrix) {
    const std::vector<double> sums = row_sums_global(comm, matrix);
    return std::accumulate(sums.begin(), sums.end(), 0.0);
}

SparseRows weighted_sum(std::span<const WeightedMatrix> terms) {
    const SparseRowsView& first = terms.front().matrix;
    SparseRows sum;
    sum.size = first.size;
    sum.rows = first.rows;
    std::size_t entries = 0;  // at most, and nearly: a place rarely has a value in two terms
    for (const WeightedMatrix& term : terms) entries += term.weight == 0.0 ? 0 : term.matrix.values.size();
    sum.columns.reserve(entries);
    sum.values.reserve(entries);
    sum.offsets.reserve(first.offsets.size());
    std::vector<std::pair<int, double>> row;
    for (std::size_t r = 0; r < at(first.local_rows()); ++r) {
        row.clear();
        for (const WeightedMatrix& term : terms) {
            if (term.weight == 0.0) continue;
            for (auto k = term.matrix.offsets[r]; k < term.matrix.offsets[r + 1]; ++k) {
                const auto e = at(k);
                row.emplace_back(term.matrix.columns[e], term.weight * term.matrix.values[e]);
            }
        }
        std::stable_sort(row.begin(), row.end(),
                         [](const auto& a, const auto& b) { return a.first < b.first; });
        const auto row_begin = at(sum.offsets.back());
        for (const auto& [column, value] : row) {
            if (sum.columns.size() > row_begin && sum.columns.back() == column) {
                sum.values.back() += value;
            } else {
                sum.columns.push_back(column);
                sum.values.push_back(value);
            }
        }
        sum.offsets.push_back(static_cast<std::int64_t>(sum.columns.size()));
    }
    return sum;
}

void drop_small_entries(SparseRows& matrix, double threshold) {
    std::size_t kept = 0;
    std::size_t next = 0;
    for (std::size_t r = 0; r < at(matrix.local_rows()); ++r) {
        for (; next < at(matrix.offsets[r + 1]); ++next) {
            if (matrix.values[next] < threshold) continue;
            matrix.columns[kept] = matrix.columns[next];
            matrix.values[kept++] = matrix.values[next];
        }
        matrix.offsets[r + 1] = static_cast<std::int64_t>(kept);
    }
    matrix.columns.resize(kept);
    matrix.values.resize(kept);
}

}  // namespace coseg
