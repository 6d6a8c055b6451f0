#pragma once
// Reads bytes that are written as text in base64.

#include <optional>
#include <string_view>
#include <vector>

namespace coseg {

/// The bytes of such a text, with or without '=' at its end. Nothing if another character stands in it, or if
/// its length is that of no bytes. Source: RFC 4648, section 4.
std::optional<std::vector<char>> bytes_of_base64(std::string_view text);

}  // namespace coseg
