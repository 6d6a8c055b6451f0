#pragma once
// The part of mesh scope's pass that is not a matrix product, for the widest vectors that the machine has.

#include <cstddef>

namespace coseg {

/// squares[p] += max(scores[p] - price, 0)^2 for p < count.
void add_excess_squares(const double* scores, double price, std::size_t count, double* squares);

}  // namespace coseg
