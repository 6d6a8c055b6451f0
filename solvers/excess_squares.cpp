#include "solvers/excess_squares.hpp"

#include <algorithm>

// Distributed binaries are built for the least of the machines; gcc then picks the widest form at run time. The
// sanitizers cannot instrument that choice.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__)
#define COSEG_FOR_EVERY_WIDTH __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define COSEG_FOR_EVERY_WIDTH
#endif

namespace coseg {

COSEG_FOR_EVERY_WIDTH
void add_excess_squares(const float* scores, float price, std::size_t count, float* squares) {
    for (std::size_t p = 0; p < count; ++p) {
        const float excess = std::max(scores[p] - price, 0.0F);
        squares[p] += excess * excess;
    }
}

COSEG_FOR_EVERY_WIDTH
void add_excess_squares(const double* scores, double price, std::size_t count, double* squares) {
    for (std::size_t p = 0; p < count; ++p) {
        const double excess = std::max(scores[p] - price, 0.0);
        squares[p] += excess * excess;
    }
}

}  // namespace coseg
