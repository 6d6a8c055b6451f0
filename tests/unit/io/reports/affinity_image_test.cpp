#include "io/reports/affinity_image.hpp"

#include <gtest/gtest.h>

#include "src/pictures/part_colors.hpp"

namespace coseg {
namespace {

Color color_at(const Image& image, int x, int y) {
    const std::uint8_t* pixel = image.pixel(x, y);
    return {pixel[0], pixel[1], pixel[2]};
}

TEST(AffinityImage, StrongLinksAreDarkAndPartsHaveTheirColours) {
    // 4 bins of 120 pixels, from pixel 28 on; parts of 1 and 3 bins.
    const Image image = affinity_image({"z000", "0z90", "09z0", "000z"}, {1, 4});
    ASSERT_EQ(image.width, 480 + 40);
    ASSERT_EQ(image.height, image.width);
    const auto bin = [&](int row, int column) {
        return color_at(image, 28 + 120 * column + 60, 28 + 120 * row + 60);
    };
    EXPECT_EQ(bin(0, 3), (Color{255, 255, 255}));
    EXPECT_EQ(bin(0, 0), bin(3, 3));
    EXPECT_LT(bin(0, 0)[0], 20);
    EXPECT_GT(bin(1, 2)[0], bin(0, 0)[0]);
    EXPECT_LT(bin(1, 2)[0], 255);
    EXPECT_EQ(bin(1, 2), bin(2, 1));
    EXPECT_EQ(color_at(image, 28 + 60, 15), part_color(0));
    EXPECT_EQ(color_at(image, 28 + 130, 15), part_color(1));
    EXPECT_EQ(color_at(image, 15, 28 + 60), part_color(0));
    EXPECT_EQ(color_at(image, 15, 28 + 470), part_color(1));
    EXPECT_EQ(color_at(image, 28 + 120, 28 + 200), (Color{0xD5, 0x5E, 0x00}));
}

TEST(AffinityImage, ManyBinsAreOnePixelEach) {
    const Image image = affinity_image(std::vector<std::string>(700, std::string(700, '1')), {700});
    EXPECT_EQ(image.width, 740);
    EXPECT_EQ(affinity_image({}, {}).width, 0);
}

}  // namespace
}  // namespace coseg
