#pragma once
// The matrix product behind row scope's look at all pairs, joined with what becomes of its result.

#include <cstdint>

namespace coseg {

/// Rows of a panel and columns of a group, which fill the registers of a machine with vectors of 512 bits.
constexpr int panel_rows = 48;
constexpr int group_columns = 8;

/// The rows of a panel: `depth` times its panel_rows values together. `prices`: one a row.
struct ScoredRows {
    const float* values;
    const float* prices;
};

/// Groups of columns, group by group `depth` times the group_columns values together. `errors`: one a column.
struct ScoredColumns {
    const float* values;
    const float* errors;
    int groups;
};

/// Column by column, panel_rows values each.
struct PairScores {
    float* scores;
    float* squares;
};

/// scores = A^T B for a panel of rows and groups of columns, and squares += (scores + errors - prices)_+^2, in single
/// precision.
///
/// Each score is summed in the order of `depth`, whatever the width of the vectors and the place of its row and column,
/// so its bits do not depend on who computes it beside what. About as fast as the best BLAS on a large product, which
/// would repack rows for every block of columns and leave scores to be read once more.
void score_pairs(const ScoredRows& rows, const ScoredColumns& columns, int depth, const PairScores& to);

/// Bit r of above[c]: whether value r of column c is above the limit; columns of panel_rows values.
void find_above(const float* values, int columns, float limit, std::uint64_t* above);

/// The same where it also reaches its row's or its column's bound.
void find_above(const float* values, int columns, float limit, const float* row_bounds,
                const float* column_bounds, std::uint64_t* above);

}  // namespace coseg
