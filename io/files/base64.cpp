#include "io/files/base64.hpp"

#include <cstdint>

namespace coseg {

namespace {

/// 0 .. 63; -1 for a character that base64 does not have.
int sextet_of(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    if (c == '+') return 62;
    return c == '/' ? 63 : -1;
}

}  // namespace

std::optional<std::vector<char>> bytes_of_base64(std::string_view text) {
    for (int k = 0; k < 2 && text.ends_with('='); ++k) text.remove_suffix(1);
    if (text.size() % 4 == 1) return std::nullopt;
    std::vector<char> bytes;
    bytes.reserve(text.size() / 4 * 3 + 2);
    std::uint32_t bits = 0;
    int held = 0;
    for (const char c : text) {
        const int sextet = sextet_of(c);
        if (sextet < 0) return std::nullopt;
        bits = bits << 6U | static_cast<std::uint32_t>(sextet);
        held += 6;
        if (held < 8) continue;
        held -= 8;
        bytes.push_back(static_cast<char>(bits >> static_cast<unsigned>(held) & 0xFFU));
    }
    return bytes;
}

}  // namespace coseg
