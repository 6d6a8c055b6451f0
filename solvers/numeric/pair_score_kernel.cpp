#include "solvers/numeric/pair_score_kernel.hpp"

#include <algorithm>

#include "src/base/vector_clones.hpp"

// One text for every width of vectors: the compiler's own vectors, in functions for the machines that have
// them.
#define COSEG_INLINE __attribute__((always_inline)) inline

namespace coseg {

namespace {

/// Rows that are scored at once where fewer are left than fill the registers.
constexpr int row_block = 16;
static_assert(panel_rows % row_block == 0);

/// For loops that the compiler turns into vectors; it does not with a shift.
struct Bits {
    std::uint64_t row[panel_rows];
    constexpr Bits() : row() {
        for (int r = 0; r < panel_rows; ++r) row[r] = std::uint64_t{1} << r;
    }
};
constexpr Bits bit_of;

/// `width` floats wherever they lie.
template <int width>
struct Vector {
    // NOLINTNEXTLINE(modernize-use-using): an alias cannot carry the attributes
    typedef float type __attribute__((vector_size(width * sizeof(float)), may_alias, aligned(sizeof(float))));
};

/// A block of `vectors` times `width` rows and `columns` columns, whose sums stay in registers. Of the
/// columns' groups only the first.
template <int width, int vectors, int columns>
COSEG_INLINE void score_block(ScoredRows rows, ScoredColumns group, int depth, PairScores to) {
    using V = typename Vector<width>::type;
    V sum[vectors][columns] = {};
    for (int k = 0; k < depth; ++k, rows.values += panel_rows, group.values += group_columns) {
        V x[vectors];
        for (int v = 0; v < vectors; ++v) x[v] = *reinterpret_cast<const V*>(rows.values + v * width);
        for (int c = 0; c < columns; ++c) {
            const V u = V{} + group.values[c];
            for (int v = 0; v < vectors; ++v) sum[v][c] += x[v] * u;
        }
    }
    for (int v = 0; v < vectors; ++v) {
        const V price = *reinterpret_cast<const V*>(rows.prices + v * width);
        for (int c = 0; c < columns; ++c) {
            const int place = c * panel_rows + v * width;
            *reinterpret_cast<V*>(to.scores + place) = sum[v][c];
            const V excess = sum[v][c] + group.errors[c] - price;
            const V positive = excess > 0.0F ? excess : V{};
            *reinterpret_cast<V*>(to.squares + place) += positive * positive;
        }
    }
}

/// The rows [r, r + vectors * width) of a panel against the columns of one group.
template <int width, int vectors, int columns>
COSEG_INLINE void score_rows_of_group(ScoredRows rows, ScoredColumns group, int depth, PairScores to, int r) {
    for (int c = 0; c < group_columns; c += columns) {
        const int place = c * panel_rows + r;
        score_block<width, vectors, columns>({rows.values + r, rows.prices + r},
                                             {group.values + c, group.errors + c, 1}, depth,
                                             {to.scores + place, to.squares + place});
    }
}

/// All groups, in blocks of the given shape, and what is left of the rows in single row blocks.
template <int width, int vectors, int columns>
COSEG_INLINE void score_groups(ScoredRows rows, ScoredColumns group, int depth, PairScores to) {
    constexpr int step = vectors * width;
    constexpr int spared = std::max(step - row_block, 0);
    for (int g = 0; g < group.groups; ++g) {
        int r = 0;
        for (; r + step <= panel_rows && r + spared < rows.used; r += step)
            score_rows_of_group<width, vectors, columns>(rows, group, depth, to, r);
        for (; r < rows.used; r += row_block)
            score_rows_of_group<width, row_block / width, columns>(rows, group, depth, to, r);
        group.values += depth * group_columns;
        group.errors += group_columns;
        to.scores += panel_rows * group_columns;
        to.squares += panel_rows * group_columns;
    }
}

using ScoreGroups = void (*)(const ScoredRows&, const ScoredColumns&, int, const PairScores&);

void score_narrow(const ScoredRows& rows, const ScoredColumns& columns, int depth, const PairScores& to) {
    score_groups<4, 3, 4>(rows, columns, depth, to);
}

#if COSEG_CHOOSES_WIDTH
__attribute__((target("avx2,fma"))) void score_avx2(const ScoredRows& rows, const ScoredColumns& columns,
                                                    int depth, const PairScores& to) {
    score_groups<8, 3, 4>(rows, columns, depth, to);
}

__attribute__((target("avx512f,fma"))) void score_avx512(const ScoredRows& rows, const ScoredColumns& columns,
                                                         int depth, const PairScores& to) {
    score_groups<16, 3, 8>(rows, columns, depth, to);
}
#endif

ScoreGroups widest() {
#if COSEG_CHOOSES_WIDTH
    if (__builtin_cpu_supports("avx512f") != 0) return score_avx512;
    if (__builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0) return score_avx2;
#endif
    return score_narrow;
}

}  // namespace

void score_pairs(const ScoredRows& rows, const ScoredColumns& columns, int depth, const PairScores& to) {
    static const ScoreGroups score = widest();
    score(rows, columns, depth, to);
}

COSEG_FOR_EVERY_WIDTH
void find_above(const float* values, int columns, float limit, std::uint64_t* above) {
    for (int c = 0; c < columns; ++c, values += panel_rows) {
        std::uint64_t rows = 0;
        for (int r = 0; r < panel_rows; ++r) rows |= values[r] > limit ? bit_of.row[r] : 0;
        above[c] = rows;
    }
}

COSEG_FOR_EVERY_WIDTH
void find_above(const float* values, int columns, float limit, const float* row_bounds,
                const float* column_bounds, std::uint64_t* above) {
    for (int c = 0; c < columns; ++c, values += panel_rows) {
        std::uint64_t rows = 0;
        const float bound = column_bounds[c];
        for (int r = 0; r < panel_rows; ++r) {
            const float least = row_bounds[r] < bound ? row_bounds[r] : bound;
            rows |= ((values[r] > limit) & (values[r] >= least)) ? bit_of.row[r] : 0;
        }
        above[c] = rows;
    }
}

}  // namespace coseg
