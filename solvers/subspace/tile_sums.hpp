#pragma once
// Forms sums over the rows or columns of all ranks that have the same bits on any number of ranks.

#include <cstddef>
#include <cstdint>
#include <utility>

#include "solvers/subspace/coefficients.hpp"
#include "src/parallel/exact_sum.hpp"

namespace coseg {

/// Calls add(i, sums) for each of `items` rows or columns, the first of which begins a coefficient tile. The
/// values that it adds to sums[0] .. sums[count - 1] are added up tile by tile, in order. Each tile is one
/// addend of the scalars `first`, first + 1, and so on. Bits do not depend on the ranks because ranks own
/// whole tiles.
template <std::size_t count, class Add>
void add_by_tiles(std::int64_t items, std::size_t first, ExactSum& sums, Add&& add) {
    double tile[count] = {};
    for (std::int64_t i = 0; i < items; ++i) {
        add(i, tile);
        if ((i + 1) % coefficient_tile != 0 && i + 1 != items) continue;
        for (std::size_t k = 0; k < count; ++k) sums.add_scalar(first + k, std::exchange(tile[k], 0.0));
    }
}

}  // namespace coseg
