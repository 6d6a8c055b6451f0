#include "solvers/spectral/tile_kernels.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "solvers/affinity/sparse_rows.hpp"
#include "src/base/index.hpp"
#include "src/base/vector_clones.hpp"

namespace coseg {

namespace {

constexpr std::size_t lanes = 8;
constexpr std::size_t held_rows = 16;
constexpr auto tile_rows = static_cast<std::size_t>(row_tile);
using Tile = std::array<double, tile_rows>;

/// The products of one tile; eight sums side by side, joined in a fixed order.
COSEG_VECTOR_CLONES void tile_products(const double* const* y, std::size_t columns, std::size_t first,
                                       const double* x, double* results) {
    for (std::size_t j = 0; j < columns; ++j) {
        const double* const column = y[j] + first;
        std::array<double, lanes> sums{};
        for (std::size_t i = 0; i < tile_rows; i += lanes) {
            COSEG_LANES_LOOP
            for (std::size_t l = 0; l < lanes; ++l) sums[l] += x[i + l] * column[i + l];
        }
        results[j] =
            ((sums[0] + sums[4]) + (sums[2] + sums[6])) + ((sums[1] + sums[5]) + (sums[3] + sums[7]));
    }
}

/// y += sum_j weights_j x_j in one tile, as many rows at a time as registers hold.
COSEG_VECTOR_CLONES void tile_multiples(const double* const* x, std::size_t columns, std::size_t first,
                                        const double* weights, double* y) {
    for (std::size_t row = 0; row < tile_rows; row += held_rows) {
        std::array<double, held_rows> sums;
        COSEG_LANES_LOOP
        for (std::size_t l = 0; l < held_rows; ++l) sums[l] = y[row + l];
        for (std::size_t j = 0; j < columns; ++j) {
            const double* const column = x[j] + first + row;
            const double weight = weights[j];
            COSEG_LANES_LOOP
            for (std::size_t l = 0; l < held_rows; ++l) sums[l] += weight * column[l];
        }
        COSEG_LANES_LOOP
        for (std::size_t l = 0; l < held_rows; ++l) y[row + l] = sums[l];
    }
}

/// A short last tile is worked on as a whole one that ends in zeros.
Tile padded(const double* from, std::size_t rows) {
    Tile tile{};
    std::copy_n(from, rows, tile.begin());
    return tile;
}

/// Calls whole(first) for each whole tile, and rest(first, rows) for what is left.
template <class Whole, class Rest>
void for_tiles(std::int64_t length, Whole&& whole, Rest&& rest) {
    const auto all = at(length);
    const std::size_t end = all - all % tile_rows;
    for (std::size_t first = 0; first < end; first += tile_rows) whole(first);
    if (end < all) rest(end, all - end);
}

/// The tiles of several columns, one after the other in memory.
class TileBlock {
  public:
    explicit TileBlock(std::size_t columns) : values_(columns) {
        for (const Tile& tile : values_) pointers_.push_back(tile.data());
    }
    void load(std::span<const double* const> columns, std::size_t first, std::size_t rows) {
        for (std::size_t j = 0; j < columns.size(); ++j) {
            if (rows < tile_rows) values_[j].fill(0.0);
            std::copy_n(columns[j] + first, rows, values_[j].begin());
        }
    }
    [[nodiscard]] const std::vector<const double*>& pointers() const { return pointers_; }

  private:
    std::vector<Tile> values_;
    std::vector<const double*> pointers_;
};

}  // namespace

void add_products(std::span<const double* const> y, const double* x, std::int64_t length, ExactSum& sums) {
    std::vector<double> results(y.size());
    const auto add = [&] {
        for (std::size_t j = 0; j < results.size(); ++j) sums.add_scalar(j, results[j]);
    };
    const auto whole = [&](std::size_t first) {
        tile_products(y.data(), y.size(), first, x + first, results.data());
        add();
    };
    for_tiles(length, whole, [&](std::size_t first, std::size_t rows) {
        TileBlock block(y.size());
        block.load(y, first, rows);
        tile_products(block.pointers().data(), y.size(), 0, padded(x + first, rows).data(), results.data());
        add();
    });
}

void add_multiples(std::span<const double* const> x, const double* weights, double* y, std::int64_t length) {
    const auto whole = [&](std::size_t first) {
        tile_multiples(x.data(), x.size(), first, weights, y + first);
    };
    for_tiles(length, whole, [&](std::size_t first, std::size_t rows) {
        TileBlock block(x.size());
        block.load(x, first, rows);
        Tile sum = padded(y + first, rows);
        tile_multiples(block.pointers().data(), x.size(), 0, weights, sum.data());
        std::copy_n(sum.begin(), rows, y + first);
    });
}

void combine_columns(std::span<const double* const> x, ColumnMajor q, std::span<double* const> results,
                     std::int64_t length) {
    TileBlock block(x.size());
    const auto combine = [&](std::size_t first, std::size_t rows) {
        block.load(x, first, rows);
        for (std::size_t c = 0; c < results.size(); ++c) {
            Tile sum{};
            const double* const weights = q.values + static_cast<std::int64_t>(c) * q.stride;
            tile_multiples(block.pointers().data(), x.size(), 0, weights, sum.data());
            std::copy_n(sum.begin(), rows, results[c] + first);
        }
    };
    for_tiles(
        length, [&](std::size_t first) { combine(first, tile_rows); }, combine);
}

}  // namespace coseg
