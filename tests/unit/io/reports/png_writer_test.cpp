#include "io/reports/png_writer.hpp"

#include <gtest/gtest.h>
#include <png.h>

#include "io/files/file_contents.hpp"
#include "src/base/error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace coseg {
namespace {

Image gradient() {
    Image image(37, 11, {0, 0, 0});
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            image.pixel(x, y)[0] = static_cast<std::uint8_t>(6 * x);
            image.pixel(x, y)[1] = static_cast<std::uint8_t>(20 * y);
            image.pixel(x, y)[2] = static_cast<std::uint8_t>(x * y);
        }
    }
    return image;
}

TEST(PngWriter, LibpngReadsBackThePixels) {
    const Image image = gradient();
    const std::string bytes = png_bytes(image);
    png_image read{};
    read.version = PNG_IMAGE_VERSION;
    ASSERT_NE(png_image_begin_read_from_memory(&read, bytes.data(), bytes.size()), 0) << read.message;
    ASSERT_EQ(static_cast<int>(read.width), image.width);
    ASSERT_EQ(static_cast<int>(read.height), image.height);
    read.format = PNG_FORMAT_RGB;
    std::vector<std::uint8_t> pixels(PNG_IMAGE_SIZE(read));
    ASSERT_NE(png_image_finish_read(&read, nullptr, pixels.data(), 0, nullptr), 0) << read.message;
    EXPECT_EQ(pixels, image.bytes);
}

TEST(PngWriter, FileHoldsTheBytes) {
    const test::TemporaryFolder folder;
    write_png(folder.path("a.png"), gradient());
    EXPECT_EQ(read_file(folder.path("a.png")), png_bytes(gradient()));
}

TEST(PngWriter, RefusesAnEmptyPicture) { EXPECT_THROW(png_bytes(Image()), Error); }

}  // namespace
}  // namespace coseg
