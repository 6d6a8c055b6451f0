#pragma once
// What pages that are one file are put together with.

#include <map>
#include <string>
#include <string_view>

#include "src/pictures/image.hpp"

namespace coseg {

std::string base64(std::string_view bytes);

/// The text of a script without what would end the script's element.
std::string inside_script(std::string_view text);

/// "#rrggbb".
std::string hex_color(const Color& color);

/// The page's text with the pieces in place of their @NAME@; names that no piece has become nothing.
std::string filled(std::string_view page, const std::map<std::string, std::string, std::less<>>& pieces);

}  // namespace coseg
