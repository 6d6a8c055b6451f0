#include "src/pictures/color_scale.hpp"

#include <algorithm>
#include <cmath>

namespace coseg {

namespace {

constexpr std::array<Color, 6> anchors{{{0x2A, 0x12, 0x5E},
                                        {0x2B, 0x4C, 0x9B},
                                        {0x1F, 0x87, 0xA1},
                                        {0x3D, 0xB3, 0x83},
                                        {0xA8, 0xD2, 0x55},
                                        {0xFD, 0xE9, 0x5A}}};
constexpr Color unknown = {0x9A, 0x9A, 0x9A};

}  // namespace

Color scale_color(double value, double low, double high) {
    if (std::isnan(value)) return unknown;
    const double share = high > low ? std::clamp((value - low) / (high - low), 0.0, 1.0) : 0.5;
    const double place = share * (anchors.size() - 1);
    const std::size_t below = std::min(static_cast<std::size_t>(place), anchors.size() - 2);
    const double t = place - static_cast<double>(below);
    Color color{};
    for (std::size_t c = 0; c < 3; ++c) {
        color[c] =
            static_cast<std::uint8_t>(std::lround((1.0 - t) * anchors[below][c] + t * anchors[below + 1][c]));
    }
    return color;
}

}  // namespace coseg
