#pragma once
// The matrix product of the passes over all pairs. It forms the squares of what exceeds the prices in the
// same loop.

#include <cstdint>

namespace coseg {

/// The rows of a panel and the columns of a group. They fill the registers of a machine with vectors of 512
/// bits.
constexpr int panel_rows = 48;
constexpr int group_columns = 8;

/// The rows of a panel: `depth` times, its panel_rows values together. There is one of `prices` for each row.
/// Only the first `used` need results.
struct ScoredRows {
    const float* values;
    const float* prices;
    int used = panel_rows;
};

/// Groups of columns: group by group and `depth` times, the group_columns values together. There is one of
/// `errors` for each column.
struct ScoredColumns {
    const float* values;
    const float* errors;
    int groups;
};

/// Where the values of a column lie in groups of columns of `depth` values: the first one; each of the others
/// is group_columns after the one before it.
template <class Float>
Float* column_in_groups(Float* groups, int column, int depth) {
    return groups + std::int64_t{column / group_columns} * depth * group_columns + column % group_columns;
}

/// The results, column by column, panel_rows values each.
struct PairScores {
    float* scores;
    float* squares;
};

/// Computes scores = A^T B for a panel of rows and groups of columns, and squares += (scores + errors -
/// prices)_+^2, in single precision. Results of rows that are not used may have any value.
///
/// Each score is summed in the order of `depth`, whatever the width of the vectors and the place of its row
/// and column. Its bits depend neither on which rank computes it, nor on what is computed beside it. The
/// kernel is about as fast as the best BLAS on a large product. A BLAS would pack rows again for every block
/// of columns, and its scores would have to be read once more.
void score_pairs(const ScoredRows& rows, const ScoredColumns& columns, int depth, const PairScores& to);

/// Sets bit r of above[c] if value r of column c is above the limit. Columns have panel_rows values.
void find_above(const float* values, int columns, float limit, std::uint64_t* above);

/// The same for values that also reach the bound of their row or of their column.
void find_above(const float* values, int columns, float limit, const float* row_bounds,
                const float* column_bounds, std::uint64_t* above);

}  // namespace coseg
