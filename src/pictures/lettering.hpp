#pragma once
// Writes text into a picture without a font file.

#include <string>

#include "src/pictures/image.hpp"

namespace coseg {

/// Draws ASCII text (any other byte as a box) with its baseline's left end at (x, y), capitals `height`
/// pixels tall, anti-aliased. What lies outside the image is left out.
void draw_text(Image& image, double x, double y, const std::string& text, double height, const Color& color);

/// The width in pixels that draw_text takes.
double text_width(const std::string& text, double height);

/// The text if it is at most `width` pixels wide, else its two ends with ".." between.
std::string shortened_text(const std::string& text, double height, double width);

}  // namespace coseg
