#pragma once
// Writes pictures as PNG files.

#include <string>

#include "src/pictures/image.hpp"

namespace coseg {

/// The picture as the bytes of a PNG file: 8 bits a channel, sRGB, no time stamp, so the same picture gives
/// the same bytes. Throws Error(internal) if libpng refuses it (an empty picture).
std::string png_bytes(const Image& image);

/// Writes the file whole or not at all. Throws Error(output) as atomic_file.hpp does.
void write_png(const std::string& path, const Image& image);

}  // namespace coseg
