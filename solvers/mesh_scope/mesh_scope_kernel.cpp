#include "solvers/mesh_scope/mesh_scope_kernel.hpp"

#include <algorithm>

#include "src/base/vector_clones.hpp"

namespace coseg {

COSEG_FOR_EVERY_WIDTH
void add_excess_squares(const double* scores, double price, std::size_t count, double* squares) {
    for (std::size_t p = 0; p < count; ++p) {
        const double excess = std::max(scores[p] - price, 0.0);
        squares[p] += excess * excess;
    }
}

}  // namespace coseg
