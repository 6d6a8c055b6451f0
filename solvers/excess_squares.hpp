#pragma once
// The part of a pass over all pairs that is not a matrix product, for the widest vectors that the machine has.

#include <cstddef>

namespace coseg {

/// squares[p] += max(scores[p] + error - prices[p], 0)^2 for p < count. Each result is a function of its own
/// arguments, whatever the width of the vectors.
void add_excess_squares(const float* scores, const float* prices, float error, std::size_t count,
                        float* squares);

/// The same with one price for all and no error.
void add_excess_squares(const float* scores, float price, std::size_t count, float* squares);
void add_excess_squares(const double* scores, double price, std::size_t count, double* squares);

/// Whether values[p] > limit for some p < count.
bool any_above(const float* values, float limit, std::size_t count);

/// Whether for some p < count values[p] > limit, and values[p] >= its own or the common bound.
bool any_above(const float* values, float limit, const float* own_bounds, float common_bound,
               std::size_t count);

}  // namespace coseg
