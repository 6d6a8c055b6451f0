#pragma once
// The coefficients W as the solvers return them: the nonzero pairs of the columns that this rank owns.

#include <cstdint>
#include <vector>

#include "src/parallel/block_range.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

/// Columns are owned in whole tiles: block_range(N, ranks, rank, coefficient_tile).
inline constexpr std::int64_t coefficient_tile = 32;

/// A sparse matrix compressed by columns, in which the H values of a pair stand together. Column
/// `columns.begin + c` holds the entries offsets[c] .. offsets[c + 1]. Entry e is row rows[e] and has the
/// values values[H e] .. values[H e + H - 1].
struct SparseCoefficients {
    std::int64_t size = 0;              ///< N
    BlockRange columns;                 ///< owned by this rank
    int features = 0;                   ///< H
    std::vector<std::int64_t> offsets;  ///< columns.size() + 1
    std::vector<int> rows;              ///< ascending within a column, never the column itself
    /// The values are >= 0 except for variants of free sign. At least one of the H values of a pair is not 0.
    std::vector<double> values;
};

/// The columns of all ranks, on all ranks: for small problems and for results that everyone asks for.
/// Collective.
SparseCoefficients all_gathered(const Comm& comm, const SparseCoefficients& local);
/// The same on the root alone; elsewhere there are no columns. Collective.
SparseCoefficients gathered(const Comm& comm, const SparseCoefficients& local);

/// ||w_ij||_2 over the features, of each entry.
std::vector<double> pair_norms(const SparseCoefficients& coefficients);

}  // namespace coseg
