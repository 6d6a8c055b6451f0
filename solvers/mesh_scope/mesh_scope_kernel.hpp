#pragma once
// The part of mesh scope's pass that is not a matrix product, for the widest vectors that the machine has.

#include <cstddef>

namespace coseg {

/// squares[p] += max(scores[p] - price, 0)^2 for p < count. Each result is a function of its own arguments,
/// whatever the width of the vectors.
void add_excess_squares(const float* scores, float price, std::size_t count, float* squares);
void add_excess_squares(const double* scores, double price, std::size_t count, double* squares);

}  // namespace coseg
