#include "src/base/text.hpp"

#include <charconv>
#include <cstdio>

namespace coseg {

std::string significant(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
}

std::string decimal(double value, int digits) {
    std::string text(32, '\0');
    const int length = std::snprintf(text.data(), text.size(), "%.*f", digits, value);
    if (length >= static_cast<int>(text.size())) {
        text.resize(static_cast<std::size_t>(length) + 1);
        std::snprintf(text.data(), text.size(), "%.*f", digits, value);
    }
    text.resize(static_cast<std::size_t>(length));
    return text;
}

std::string percent(double share, int digits) { return decimal(100.0 * share, digits) + " %"; }

std::optional<int> whole_number(std::string_view text) {
    int number = 0;
    const char* end = text.data() + text.size();
    const auto [stop, failure] = std::from_chars(text.data(), end, number);
    if (failure != std::errc() || stop != end) return std::nullopt;
    return number;
}

std::string escaped(std::string_view text) {
    std::string safe;
    for (const char c : text) {
        if (c == '<')
            safe += "&lt;";
        else if (c == '&')
            safe += "&amp;";
        else if (c == '"')
            safe += "&quot;";
        else
            safe += c;
    }
    return safe;
}

std::string with_unit(std::int64_t count, const std::string& one, const std::string& many) {
    return std::to_string(count) + " " + (count == 1 ? one : many);
}

bool is_utf8(std::string_view bytes) {
    const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(bytes[k]); };
    for (std::size_t k = 0; k < bytes.size();) {
        const unsigned first = byte(k);
        const std::size_t more = first < 0x80   ? 0
                                 : first < 0xC2 ? 4
                                 : first < 0xE0 ? 1
                                 : first < 0xF0 ? 2
                                                : 3;
        if (more == 4 || first > 0xF4 || bytes.size() - k <= more) return false;
        for (std::size_t i = 1; i <= more; ++i) {
            if ((byte(k + i) & 0xC0U) != 0x80) return false;
        }
        const bool is_out_of_range =
            (first == 0xE0 && byte(k + 1) < 0xA0) || (first == 0xED && byte(k + 1) >= 0xA0) ||
            (first == 0xF0 && byte(k + 1) < 0x90) || (first == 0xF4 && byte(k + 1) >= 0x90);
        if (is_out_of_range) return false;
        k += more + 1;
    }
    return true;
}

std::string hex_of_bytes(std::string_view bytes) {
    constexpr std::string_view digits = "0123456789abcdef";
    std::string hex;
    for (const char c : bytes) {
        const auto byte = static_cast<unsigned char>(c);
        hex += {digits[byte >> 4U], digits[byte & 15U]};
    }
    return hex;
}

std::optional<std::string> hex_unless_utf8(std::string_view bytes) {
    return is_utf8(bytes) ? std::nullopt : std::optional<std::string>(hex_of_bytes(bytes));
}

std::string bytes_of_hex(std::string_view hex) {
    std::string bytes;
    for (std::size_t k = 0; k + 1 < hex.size(); k += 2) {
        unsigned char byte = 0;
        const char* end = hex.data() + k + 2;
        if (std::from_chars(hex.data() + k, end, byte, 16).ptr != end) break;
        bytes += static_cast<char>(byte);
    }
    return bytes;
}

}  // namespace coseg
