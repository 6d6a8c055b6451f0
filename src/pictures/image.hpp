#pragma once
// A picture in memory.

#include <array>
#include <cstdint>
#include <vector>

#include "src/base/index.hpp"

namespace coseg {

using Color = std::array<std::uint8_t, 3>;  ///< red, green, blue, as sRGB

/// Pixels row by row from the top, 3 bytes each.
struct Image {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> bytes;

    Image() = default;
    Image(int columns, int rows, const Color& fill);

    [[nodiscard]] std::uint8_t* pixel(int x, int y) { return &bytes[3 * (at(y) * at(width) + at(x))]; }
    [[nodiscard]] const std::uint8_t* pixel(int x, int y) const {
        return &bytes[3 * (at(y) * at(width) + at(x))];
    }
};

/// The intensity of light, 0..1, that an sRGB value of 0..1 stands for, and back. Source: IEC 61966-2-1.
double linear_of_srgb(double value);
double srgb_of_linear(double value);

/// Blends `color` over the pixel, coverage in 0..1; outside the image nothing happens.
void blend(Image& image, int x, int y, const Color& color, double coverage);

/// Fills the part of the rectangle that lies in the image.
void fill_rectangle(Image& image, int x, int y, int width, int height, const Color& color);

/// Copies `piece` with its corner at (x, y); what lies outside is left out.
void paste(Image& image, const Image& piece, int x, int y);

/// The image made smaller. Each pixel is the mean, in intensity of light, of the area that it covers. width,
/// height: at most those of the image.
Image shrunk(const Image& image, int width, int height);

}  // namespace coseg
