#pragma once
// Text that is not in UTF-8.

#include <optional>
#include <string>
#include <string_view>

namespace coseg {

/// The byte order mark, U+FEFF, in UTF-8.
inline constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

/// The same text in UTF-8 if the bytes are text in UTF-16, of either byte order: with a byte order mark, or
/// without one if every other of the first bytes is zero. Nothing otherwise. Halves of characters that stand
/// alone become U+FFFD.
std::optional<std::string> utf8_of_utf16(std::string_view bytes);

/// The bytes as text without a mark of their encoding: what editors of Windows save in UTF-16, or with a byte
/// order mark before UTF-8, is decoded.
std::string utf8_text(std::string bytes);

}  // namespace coseg
