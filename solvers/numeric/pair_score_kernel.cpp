#include "solvers/numeric/pair_score_kernel.hpp"

#include "src/base/vector_clones.hpp"

// One text for every width of vectors: the compiler's own vectors, in functions for the machines that have them.
#define COSEG_INLINE __attribute__((always_inline)) inline

namespace coseg {

namespace {

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

/// A block of `vectors` times `width` rows and `columns` columns, whose sums stay in registers.
template <int width, int vectors, int columns>
COSEG_INLINE void score_block(const float* rows, const float* duals, int depth, const float* prices,
                              const float* errors, float* scores, float* squares) {
    using V = typename Vector<width>::type;
    V sum[vectors][columns] = {};
    for (int k = 0; k < depth; ++k, rows += panel_rows, duals += group_columns) {
        V x[vectors];
        for (int v = 0; v < vectors; ++v) x[v] = *reinterpret_cast<const V*>(rows + v * width);
        for (int c = 0; c < columns; ++c) {
            const V u = V{} + duals[c];
            for (int v = 0; v < vectors; ++v) sum[v][c] += x[v] * u;
        }
    }
    for (int v = 0; v < vectors; ++v) {
        const V price = *reinterpret_cast<const V*>(prices + v * width);
        for (int c = 0; c < columns; ++c) {
            const int place = c * panel_rows + v * width;
            *reinterpret_cast<V*>(scores + place) = sum[v][c];
            const V excess = sum[v][c] + errors[c] - price;
            const V positive = excess > 0.0F ? excess : V{};
            *reinterpret_cast<V*>(squares + place) += positive * positive;
        }
    }
}

/// All groups, in blocks of the given shape.
template <int width, int vectors, int columns>
COSEG_INLINE void score_groups(const float* rows, const float* duals, int depth, int groups,
                               const float* prices, const float* errors, float* scores, float* squares) {
    for (int g = 0; g < groups; ++g) {
        for (int r = 0; r < panel_rows; r += vectors * width) {
            for (int c = 0; c < group_columns; c += columns) {
                const int place = c * panel_rows + r;
                score_block<width, vectors, columns>(rows + r, duals + c, depth, prices + r, errors + c,
                                                     scores + place, squares + place);
            }
        }
        duals += depth * group_columns;
        errors += group_columns;
        scores += panel_rows * group_columns;
        squares += panel_rows * group_columns;
    }
}

using ScoreGroups = void (*)(const float*, const float*, int, int, const float*, const float*, float*,
                             float*);

void score_narrow(const float* rows, const float* duals, int depth, int groups, const float* prices,
                  const float* errors, float* scores, float* squares) {
    score_groups<4, 3, 4>(rows, duals, depth, groups, prices, errors, scores, squares);
}

#if COSEG_CHOOSES_WIDTH
__attribute__((target("avx2,fma"))) void score_avx2(const float* rows, const float* duals, int depth,
                                                    int groups, const float* prices, const float* errors,
                                                    float* scores, float* squares) {
    score_groups<8, 3, 4>(rows, duals, depth, groups, prices, errors, scores, squares);
}

__attribute__((target("avx512f,fma"))) void score_avx512(const float* rows, const float* duals, int depth,
                                                         int groups, const float* prices, const float* errors,
                                                         float* scores, float* squares) {
    score_groups<16, 3, 8>(rows, duals, depth, groups, prices, errors, scores, squares);
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

void score_pairs(const float* rows, const float* columns, int depth, int groups, const float* prices,
                 const float* errors, float* scores, float* squares) {
    static const ScoreGroups score = widest();
    score(rows, columns, depth, groups, prices, errors, scores, squares);
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
