#pragma once
// W as the solvers return it: the nonzero pairs of the columns that this rank owns.

#include <cstdint>
#include <vector>

#include "src/parallel/block_range.hpp"

namespace coseg {

/// Columns are owned in whole tiles: block_range(N, ranks, rank, coefficient_tile).
inline constexpr std::int64_t coefficient_tile = 32;

/// Compressed by columns; the H values of a pair stand together. Column `columns.begin + c` holds the entries
/// offsets[c] .. offsets[c + 1]; entry e is row rows[e] with the values values[H e] .. values[H e + H - 1].
struct SparseCoefficients {
    std::int64_t size = 0;              ///< N
    BlockRange columns;                 ///< owned by this rank
    int features = 0;                   ///< H
    std::vector<std::int64_t> offsets;  ///< columns.size() + 1
    std::vector<int> rows;              ///< ascending within a column, never the column itself
    /// >= 0 but for variants of free sign; at least one of the H values of a pair is not 0.
    std::vector<double> values;
};

}  // namespace coseg
