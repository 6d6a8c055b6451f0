#pragma once
// Values as colours.

#include "src/pictures/image.hpp"

namespace coseg {

/// The colour of a value in low..high, from dark violet through blue and green to yellow, rising in lightness
/// throughout, so that it reads in grey and under red-green blindness; values outside take the ends, NaN is grey.
Color scale_color(double value, double low, double high);

}  // namespace coseg
