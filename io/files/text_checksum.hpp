#pragma once
// A checksum that a JSON text carries itself: the member "text_xxh3" with 32 hexadecimal digits. They are
// those that `xxhsum -H2` prints for the text in which each of these digits is a 0.

#include <string>
#include <string_view>

namespace coseg {

inline constexpr std::string_view checksum_member = "text_xxh3";
inline constexpr std::string_view blank_checksum = "00000000000000000000000000000000";

/// Replaces the value of the first member "text_xxh3", which is blank_checksum, by the checksum of the text.
/// The text is as JsonTree writes it: a blank stands behind the colon.
std::string with_checksum(std::string text);

/// Whether the text is as with_checksum() returned it. A text without such a member is not: one flipped bit
/// can hide the name of the member.
bool has_right_checksum(std::string_view text);

}  // namespace coseg
