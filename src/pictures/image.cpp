#include "src/pictures/image.hpp"

#include <algorithm>
#include <cmath>

#include "src/base/index.hpp"

namespace coseg {

namespace {

const std::array<double, 256>& linear_table() {
    static const std::array<double, 256> table = [] {
        std::array<double, 256> values{};
        for (std::size_t i = 0; i < values.size(); ++i)
            values[i] = linear_of_srgb(static_cast<double>(i) / 255.0);
        return values;
    }();
    return table;
}

std::uint8_t byte_of(double value) {
    return static_cast<std::uint8_t>(std::clamp(std::lround(255.0 * value), 0L, 255L));
}

/// The pixels that the range [begin, end) overlaps, and by how much: visit(pixel, weight).
template <class Visit>
void overlaps(double begin, double end, int size, const Visit& visit) {
    const int last = std::min(size - 1, static_cast<int>(std::ceil(end)) - 1);
    for (int i = static_cast<int>(begin); i <= last; ++i) {
        const double weight = std::min(end, i + 1.0) - std::max(begin, static_cast<double>(i));
        if (weight > 0.0) visit(i, weight);
    }
}

}  // namespace

double linear_of_srgb(double value) {
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

double srgb_of_linear(double value) {
    return value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1.0 / 2.4) - 0.055;
}

Image::Image(int columns, int rows, const Color& fill)
    : width(columns), height(rows), bytes(3 * at(columns) * at(rows)) {
    for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = fill[i % 3];
}

void blend(Image& image, int x, int y, const Color& color, double coverage) {
    if (x < 0 || y < 0 || x >= image.width || y >= image.height || coverage <= 0.0) return;
    const double share = std::min(coverage, 1.0);
    std::uint8_t* pixel = image.pixel(x, y);
    for (std::size_t c = 0; c < 3; ++c)
        pixel[c] = byte_of((share * color[c] + (1.0 - share) * pixel[c]) / 255.0);
}

void fill_rectangle(Image& image, int x, int y, int width, int height, const Color& color) {
    for (int row = std::max(0, y); row < std::min(image.height, y + height); ++row) {
        for (int column = std::max(0, x); column < std::min(image.width, x + width); ++column)
            std::copy(color.begin(), color.end(), image.pixel(column, row));
    }
}

void paste(Image& image, const Image& piece, int x, int y) {
    const int first = std::max(0, -x);
    const int count = std::min(piece.width, image.width - x) - first;
    if (count <= 0) return;
    for (int row = std::max(0, -y); row < std::min(piece.height, image.height - y); ++row) {
        const std::uint8_t* from = piece.pixel(first, row);
        std::copy(from, from + 3 * static_cast<std::ptrdiff_t>(count), image.pixel(x + first, y + row));
    }
}

Image shrunk(const Image& image, int width, int height) {
    const std::array<double, 256>& linear = linear_table();
    const double step_x = static_cast<double>(image.width) / width;
    const double step_y = static_cast<double>(image.height) / height;
    Image small(width, height, {0, 0, 0});
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            std::array<double, 3> light{};
            overlaps(y * step_y, (y + 1) * step_y, image.height, [&](int row, double weight_y) {
                overlaps(x * step_x, (x + 1) * step_x, image.width, [&](int column, double weight_x) {
                    const std::uint8_t* pixel = image.pixel(column, row);
                    for (std::size_t c = 0; c < 3; ++c) light[c] += weight_x * weight_y * linear[pixel[c]];
                });
            });
            for (std::size_t c = 0; c < 3; ++c)
                small.pixel(x, y)[c] = byte_of(srgb_of_linear(light[c] / (step_x * step_y)));
        }
    }
    return small;
}

}  // namespace coseg
