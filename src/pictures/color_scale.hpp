#pragma once
// Shows values as colours.

#include "src/pictures/image.hpp"

namespace coseg {

/// The colour of a value in low .. high, from dark violet through blue and green to yellow. The lightness
/// rises throughout, so that the scale reads in grey and under red-green blindness. Values outside take the
/// colours of the ends, and NaN is grey.
Color scale_color(double value, double low, double high);

}  // namespace coseg
