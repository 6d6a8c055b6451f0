#include "src/pictures/contact_sheet.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "src/pictures/color_scale.hpp"
#include "src/pictures/lettering.hpp"
#include "src/pictures/shape_picture.hpp"

namespace coseg {
namespace {

int pixels_of(const Image& image, const Color& color) {
    int count = 0;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x)
            count += std::equal(color.begin(), color.end(), image.pixel(x, y)) ? 1 : 0;
    }
    return count;
}

TEST(ContactSheet, EveryTileIsOnThePage) {
    std::vector<SheetTile> tiles;
    for (int k = 0; k < 7; ++k) {
        const Color color = {static_cast<std::uint8_t>(30 * k), 255, 1};
        tiles.push_back({Image(50, 50, color), "shape " + std::to_string(k)});
    }
    SheetHeading heading;
    heading.title = "7 shapes";
    heading.legend = {{{200, 0, 0}, "part 0"}};
    const Image page = contact_sheet(tiles, heading, 3);
    for (int k = 0; k < 7; ++k)
        EXPECT_EQ(pixels_of(page, {static_cast<std::uint8_t>(30 * k), 255, 1}), 2500) << k;
    EXPECT_EQ(pixels_of(page, {200, 0, 0}), 15 * 15);
}

TEST(ContactSheet, AGridIsWiderThanHighAndHasNoEmptyRow) {
    for (int count = 1; count <= 400; ++count) {
        const int columns = sheet_columns(count);
        const int rows = (count + columns - 1) / columns;
        EXPECT_GE(columns, rows) << count;
        EXPECT_GT(count, columns * (rows - 1)) << count;
    }
}

TEST(Lettering, EveryLetterHasInkAndNoTwoAreAlike) {
    std::vector<std::vector<std::uint8_t>> seen;
    for (char letter = '!'; letter <= '~'; ++letter) {
        Image image(40, 50, {255, 255, 255});
        draw_text(image, 6.0, 36.0, std::string(1, letter), 24.0, {0, 0, 0});
        EXPECT_GT(pixels_of(image, {0, 0, 0}), 2) << letter;
        for (const auto& other : seen) EXPECT_NE(image.bytes, other) << letter;
        seen.push_back(image.bytes);
    }
}

TEST(Lettering, LongTextsLoseTheirMiddle) {
    const std::string name = "a_very_long_name_of_a_shape_0001";
    const std::string shorter = shortened_text(name, 10.0, 100.0);
    EXPECT_LE(text_width(shorter, 10.0), 100.0);
    EXPECT_TRUE(shorter.starts_with("a_v")) << shorter;
    EXPECT_TRUE(shorter.ends_with("01")) << shorter;
    EXPECT_EQ(shortened_text("cup", 10.0, 100.0), "cup");
}

TEST(ColorScale, GrowsLighterAndTakesTheEndsOutside) {
    double last = -1.0;
    for (int i = 0; i <= 50; ++i) {
        const Color color = scale_color(i, 0.0, 50.0);
        const double light = 0.2126 * linear_of_srgb(color[0] / 255.0) +
                             0.7152 * linear_of_srgb(color[1] / 255.0) +
                             0.0722 * linear_of_srgb(color[2] / 255.0);
        EXPECT_GT(light, last);
        last = light;
    }
    EXPECT_EQ(scale_color(-3.0, 0.0, 1.0), scale_color(0.0, 0.0, 1.0));
    EXPECT_EQ(scale_color(9.0, 0.0, 1.0), scale_color(1.0, 0.0, 1.0));
    EXPECT_EQ(scale_color(std::nan(""), 0.0, 1.0), (Color{0x9A, 0x9A, 0x9A}));
}

}  // namespace
}  // namespace coseg
