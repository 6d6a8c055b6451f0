#pragma once
// Writes numbers and names as messages, pages and files show them, and reads numbers back.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace coseg {

/// Three significant digits, as of "%.3g": 0.0123, 1.5e-07.
std::string significant(double value);

/// The value with a fixed number of digits behind the point.
std::string decimal(double value, int digits);

/// A share of 1 in percent, with `digits` behind the point: percent(0.5, 0) is "50 %".
std::string percent(double share, int digits);

/// A number and what it counts: "1 shape", "20 shapes".
std::string with_unit(std::int64_t count, const std::string& one, const std::string& many);

/// The whole number that all of a text is: digits, and "-" before them. Nothing where it is none or does not
/// fit.
std::optional<int> whole_number(std::string_view text);

/// `text` with the characters escaped that XML and HTML would misread, between tags or inside an attribute's
/// quotation marks.
std::string escaped(std::string_view text);

/// Whether the bytes are UTF-8, without surrogates and numbers that are written longer than need be.
bool is_utf8(std::string_view bytes);

/// Two lower-case hexadecimal digits for each byte, and the bytes of such a text. What is no pair of such
/// digits ends the bytes.
std::string hex_of_bytes(std::string_view bytes);
std::string bytes_of_hex(std::string_view hex);

/// The digits of bytes that are no UTF-8 and that JSON cannot hold; none where `bytes` are.
std::optional<std::string> hex_unless_utf8(std::string_view bytes);

}  // namespace coseg
