#include "io/reports/png_writer.hpp"

#include <png.h>

#include "io/files/atomic_file.hpp"
#include "src/base/error.hpp"

namespace coseg {

std::string png_bytes(const Image& image) {
    png_image picture{};
    picture.version = PNG_IMAGE_VERSION;
    picture.width = static_cast<png_uint_32>(image.width);
    picture.height = static_cast<png_uint_32>(image.height);
    picture.format = PNG_FORMAT_RGB;
    std::string bytes;
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(picture);
    bytes.resize(size);
    if (png_image_write_to_memory(&picture, bytes.data(), &size, 0, image.bytes.data(), 0, nullptr) == 0) {
        throw Error(ExitCode::internal, std::string("a picture of ") + std::to_string(image.width) + " x " +
                                            std::to_string(image.height) +
                                            " pixels cannot be made into PNG: " + picture.message);
    }
    bytes.resize(size);
    return bytes;
}

void write_png(const std::string& path, const Image& image) { write_file(path, png_bytes(image)); }

}  // namespace coseg
