#include "solvers/spectral/sliced_rows.hpp"

#include <algorithm>
#include <numeric>

#include "src/base/index.hpp"

namespace coseg {

namespace {

constexpr auto slice_lanes = static_cast<std::size_t>(SlicedRows::slice_rows);

/// Calls entry(k, to) for each entry k of the matrix and its place in the slices.
template <class Entry>
void for_each_entry(const SparseRows& matrix, const std::vector<int>& row,
                    const std::vector<std::int64_t>& offsets, const Entry& entry) {
    for (std::size_t place = 0; place < row.size(); ++place) {
        if (row[place] < 0) continue;
        const auto r = at(row[place]);
        std::size_t to = at(offsets[place / slice_lanes]) + place % slice_lanes;
        for (auto k = at(matrix.offsets[r]); k < at(matrix.offsets[r + 1]); ++k, to += slice_lanes)
            entry(k, to);
    }
}

}  // namespace

void SlicedRows::sort_windows(const SparseRows& matrix) {
    const auto length = [&](int r) { return matrix.offsets[at(r) + 1] - matrix.offsets[at(r)]; };
    row_.resize(at(matrix.local_rows()));
    std::iota(row_.begin(), row_.end(), 0);
    for (std::size_t begin = 0; begin < row_.size(); begin += at(window_rows)) {
        const std::size_t end = std::min(begin + at(window_rows), row_.size());
        std::stable_sort(row_.begin() + static_cast<std::ptrdiff_t>(begin),
                         row_.begin() + static_cast<std::ptrdiff_t>(end),
                         [&](int a, int b) { return length(a) > length(b); });
    }
    for (std::size_t first = 0; first < row_.size(); first += slice_lanes)
        offsets_.push_back(offsets_.back() + length(row_[first]) * slice_rows);
    row_.resize((row_.size() + slice_lanes - 1) / slice_lanes * slice_lanes, -1);
}

SlicedRows::SlicedRows(SparseRows matrix, EntryPrecision precision) {
    sort_windows(matrix);
    const auto size = at(offsets_.back());
    // One array after the other is copied and freed: large matrices are not held twice.
    columns_.assign(size, 0);
    for_each_entry(matrix, row_, offsets_,
                   [&](std::size_t k, std::size_t to) { columns_[to] = matrix.columns[k]; });
    matrix.columns = {};
    if (precision == EntryPrecision::single) {
        single_values_.assign(size, 0.0F);
        for_each_entry(matrix, row_, offsets_, [&](std::size_t k, std::size_t to) {
            single_values_[to] = static_cast<float>(matrix.values[k]);
        });
        return;
    }
    values_.assign(size, 0.0);
    for_each_entry(matrix, row_, offsets_,
                   [&](std::size_t k, std::size_t to) { values_[to] = matrix.values[k]; });
}

void SlicedRows::multiply(const double* x, double* y) const {
    if (single_values_.empty()) {
        multiply_values(values_.data(), x, y);
    } else {
        multiply_values(single_values_.data(), x, y);
    }
}

template <class Value>
void SlicedRows::multiply_values(const Value* value, const double* x, double* y) const {
    const int* column = columns_.data();
    for (std::size_t s = 0; s + 1 < offsets_.size(); ++s) {
        double sum[slice_lanes] = {};
        for (std::int64_t k = offsets_[s]; k < offsets_[s + 1]; k += slice_rows) {
            for (std::size_t i = 0; i < slice_lanes; ++i)
                sum[i] += static_cast<double>(value[i]) * x[column[i]];
            column += slice_lanes;
            value += slice_lanes;
        }
        const int* row = row_.data() + s * slice_lanes;
        for (std::size_t i = 0; i < slice_lanes; ++i) {
            if (row[i] >= 0) y[row[i]] = sum[i];
        }
    }
}

}  // namespace coseg
