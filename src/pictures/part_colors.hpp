#pragma once
// One colour for every part, the same in every picture.

#include "src/pictures/image.hpp"

namespace coseg {

inline constexpr int part_color_count = 64;

/// The colour of part 0, 1, and so on. Beyond part_color_count - 1, and below 0, colours repeat. The first
/// seven are those of Okabe and Ito (2008) without black, which differ under red-green blindness as well.
/// Each further one was chosen once from a grid of 4,096 colours, as the one farthest from all before it. The
/// distance is the least OKLab distance (Ottosson 2020) for normal, protanope and deuteranope sight
/// (simulated after Machado, Oliveira, Fernandes 2009), where the latter two count one and a half times.
Color part_color(int part);

}  // namespace coseg
