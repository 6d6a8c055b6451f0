#include "io/reports/affinity_image.hpp"

#include <array>
#include <cmath>

#include "src/base/index.hpp"
#include "src/pictures/part_colors.hpp"

namespace coseg {

namespace {

constexpr int least_width = 480;
constexpr int strip = 12;
constexpr int gap = 4;
constexpr int margin = 12;
constexpr Color white = {0xFF, 0xFF, 0xFF};
constexpr Color line = {0xD5, 0x5E, 0x00};
constexpr Color strongest = {0x08, 0x30, 0x6B};

double level_of(char digit) { return (digit <= '9' ? digit - '0' : digit - 'a' + 10) / 35.0; }

Color shade_of(char digit) {
    Color shade{};
    for (std::size_t k = 0; k < shade.size(); ++k) {
        const double value = white[k] + level_of(digit) * (strongest[k] - white[k]);
        shade[k] = static_cast<std::uint8_t>(std::lround(value));
    }
    return shade;
}

/// The strips along the sides and a line after every part but the last.
void mark_parts(Image& image, const std::vector<int>& part_ends, int scale, int origin, int width) {
    int begin = 0;
    for (std::size_t part = 0; part < part_ends.size(); ++part) {
        const int end = part_ends[part];
        const Color color = part_color(static_cast<int>(part));
        fill_rectangle(image, origin + begin * scale, margin, (end - begin) * scale, strip, color);
        fill_rectangle(image, margin, origin + begin * scale, strip, (end - begin) * scale, color);
        if (part + 1 < part_ends.size()) {
            fill_rectangle(image, origin + end * scale, origin, 1, width, line);
            fill_rectangle(image, origin, origin + end * scale, width, 1, line);
        }
        begin = end;
    }
}

}  // namespace

Image affinity_image(const std::vector<std::string>& rows, const std::vector<int>& part_ends) {
    if (rows.empty()) return {};
    const int bins = static_cast<int>(rows.size());
    const int scale = (least_width + bins - 1) / bins;
    const int origin = margin + strip + gap;
    const int width = bins * scale;
    Image image(origin + width + margin, origin + width + margin, white);
    for (int y = 0; y < bins; ++y) {
        const std::string& row = rows[at(y)];
        for (int x = 0; x < bins; ++x) {
            fill_rectangle(image, origin + x * scale, origin + y * scale, scale, scale, shade_of(row[at(x)]));
        }
    }
    mark_parts(image, part_ends, scale, origin, width);
    return image;
}

}  // namespace coseg
