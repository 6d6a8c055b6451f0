#include "io/files/text_checksum.hpp"

#include <algorithm>

#include "io/files/content_hash.hpp"

namespace coseg {

namespace {

/// Where the digits stand; npos if the text has no such member.
std::size_t place_of_checksum(std::string_view text) {
    const std::string before = "\"" + std::string(checksum_member) + "\": \"";
    const std::size_t place = text.find(before);
    return place == std::string_view::npos ? place : place + before.size();
}

std::string checksum_at(std::string_view text, std::size_t place) {
    const std::size_t end = std::min(text.size(), place + blank_checksum.size());
    ContentHasher hasher;
    hasher.add_bytes(text.data(), place);
    hasher.add_bytes(blank_checksum.data(), blank_checksum.size());
    hasher.add_bytes(text.data() + end, text.size() - end);
    return hasher.result().hex();
}

}  // namespace

std::string with_checksum(std::string text) {
    const std::size_t place = place_of_checksum(text);
    if (place != std::string::npos) text.replace(place, blank_checksum.size(), checksum_at(text, place));
    return text;
}

bool has_right_checksum(std::string_view text) {
    const std::size_t place = place_of_checksum(text);
    return place != std::string_view::npos &&
           text.substr(place, blank_checksum.size()) == checksum_at(text, place);
}

}  // namespace coseg
