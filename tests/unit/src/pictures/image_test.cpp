#include "src/pictures/image.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace coseg {
namespace {

TEST(Image, SrgbAndLightAreInverse) {
    for (int i = 0; i <= 255; ++i) EXPECT_NEAR(srgb_of_linear(linear_of_srgb(i / 255.0)), i / 255.0, 1e-12);
    EXPECT_NEAR(linear_of_srgb(0.5), 0.21404, 1e-5);  // IEC 61966-2-1
}

TEST(Image, ShrinkingAveragesLightNotBytes) {
    Image board(2, 2, {0, 0, 0});
    for (int i = 0; i < 2; ++i) fill_rectangle(board, i, i, 1, 1, {255, 255, 255});
    // Half the light of white is 188 in sRGB, not 128.
    EXPECT_EQ(static_cast<int>(shrunk(board, 1, 1).pixel(0, 0)[0]), 188);
}

TEST(Image, ShrinkingKeepsAnEvenColourAtAnyRatio) {
    const Image even(7, 5, {10, 120, 240});
    const Image small = shrunk(even, 3, 2);
    for (std::size_t i = 0; i < small.bytes.size(); ++i) EXPECT_EQ(small.bytes[i], even.bytes[i % 3]);
}

TEST(Image, NothingIsDrawnOutside) {
    Image image(4, 4, {1, 2, 3});
    const Image before = image;
    blend(image, -1, 0, {255, 0, 0}, 1.0);
    blend(image, 0, 4, {255, 0, 0}, 1.0);
    fill_rectangle(image, 4, 0, 3, 3, {255, 0, 0});
    paste(image, Image(2, 2, {255, 0, 0}), 4, 4);
    paste(image, Image(2, 2, {255, 0, 0}), -2, 0);
    EXPECT_EQ(image.bytes, before.bytes);
    paste(image, Image(2, 2, {255, 0, 0}), -1, 3);
    EXPECT_EQ(static_cast<int>(image.pixel(0, 3)[0]), 255);
    EXPECT_EQ(static_cast<int>(image.pixel(1, 3)[0]), 1);
}

}  // namespace
}  // namespace coseg
