#include "io/files/text_encoding.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace coseg {

namespace {

enum class ByteOrder { little, big };

/// The 16-bit units of the bytes; a last odd byte is left out.
class Utf16Units {
  public:
    Utf16Units(std::string_view bytes, ByteOrder order) : bytes_(bytes), low_(order == ByteOrder::big) {}
    [[nodiscard]] std::size_t size() const { return bytes_.size() / 2; }
    char32_t operator[](std::size_t k) const {
        const auto low = static_cast<std::uint8_t>(bytes_[2 * k + (low_ ? 1 : 0)]);
        const auto high = static_cast<std::uint8_t>(bytes_[2 * k + (low_ ? 0 : 1)]);
        return static_cast<char32_t>(low | high << 8U);
    }

  private:
    std::string_view bytes_;
    bool low_;  ///< whether the low byte comes second
};

constexpr char32_t utf16_mark = 0xFEFF;
constexpr char32_t replacement = 0xFFFD;
constexpr std::size_t looked_at = 40;

/// Whether the first units could be text: binary data soon has a zero.
bool is_text(const Utf16Units& units, char32_t largest) {
    const std::size_t count = std::min(units.size(), looked_at);
    for (std::size_t k = 0; k < count; ++k) {
        if (units[k] < '\t' || units[k] > largest) return false;
    }
    return count >= 2;
}

bool is_utf16(const Utf16Units& units) {
    constexpr char32_t largest_of_ascii = 0x7E;
    const bool has_mark = units.size() > 0 && units[0] == utf16_mark;
    return is_text(units, has_mark ? 0xFFFF : largest_of_ascii);
}

bool is_high_half(char32_t unit) { return unit >= 0xD800 && unit < 0xDC00; }
bool is_low_half(char32_t unit) { return unit >= 0xDC00 && unit < 0xE000; }

void append_utf8(std::string& text, char32_t c) {
    const auto put = [&](char32_t byte) { text.push_back(static_cast<char>(byte)); };
    const auto put_rest = [&](unsigned shift) { put(0x80U | (c >> shift & 0x3FU)); };
    if (c < 0x80) {
        put(c);
    } else if (c < 0x800) {
        put(0xC0U | c >> 6U);
        put_rest(0);
    } else if (c < 0x10000) {
        put(0xE0U | c >> 12U);
        put_rest(6);
        put_rest(0);
    } else {
        put(0xF0U | c >> 18U);
        put_rest(12);
        put_rest(6);
        put_rest(0);
    }
}

std::string utf8_of(const Utf16Units& units) {
    std::string text;
    text.reserve(units.size());
    for (std::size_t k = units[0] == utf16_mark ? 1 : 0; k < units.size(); ++k) {
        const char32_t unit = units[k];
        if (is_high_half(unit) && k + 1 < units.size() && is_low_half(units[k + 1])) {
            append_utf8(text, 0x10000 + ((unit - 0xD800) << 10U) + (units[k + 1] - 0xDC00));
            ++k;
        } else {
            append_utf8(text, is_high_half(unit) || is_low_half(unit) ? replacement : unit);
        }
    }
    return text;
}

}  // namespace

std::optional<std::string> utf8_of_utf16(std::string_view bytes) {
    for (const ByteOrder order : {ByteOrder::little, ByteOrder::big}) {
        const Utf16Units units(bytes, order);
        if (is_utf16(units)) return utf8_of(units);
    }
    return std::nullopt;
}

std::string utf8_text(std::string bytes) {
    if (std::optional<std::string> decoded = utf8_of_utf16(bytes)) return *std::move(decoded);
    if (bytes.starts_with(byte_order_mark)) bytes.erase(0, byte_order_mark.size());
    return bytes;
}

}  // namespace coseg
