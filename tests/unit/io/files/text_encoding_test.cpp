#include "io/files/text_encoding.hpp"

#include <gtest/gtest.h>

namespace coseg {
namespace {

/// The whole literal, also behind a zero.
template <std::size_t N>
std::string with_zeros(const char (&literal)[N]) {
    return std::string(literal, N - 1);
}

TEST(TextEncoding, Utf16BecomesUtf8) {
    EXPECT_EQ(utf8_of_utf16(with_zeros("\xff\xfe") + with_zeros("a\0b\0")), "ab");
    EXPECT_EQ(utf8_of_utf16(with_zeros("\xfe\xff") + with_zeros("\0a\0b")), "ab");
    EXPECT_EQ(utf8_of_utf16(with_zeros("a\0b\0\n\0")), "ab\n");
    EXPECT_EQ(utf8_of_utf16(with_zeros("\xff\xfe\xe4\x00\xac\x20\x3d\xd8\x00\xde")),
              "\xc3\xa4\xe2\x82\xac\xf0\x9f\x98\x80");
    EXPECT_EQ(utf8_of_utf16(with_zeros("\xff\xfe\x3d\xd8") + with_zeros("a\0")),
              with_zeros("\xef\xbf\xbd") + "a");
}

TEST(TextEncoding, OtherBytesAreNotTouched) {
    for (const std::string& bytes :
         {with_zeros(""), with_zeros("a"), with_zeros("ab"), with_zeros("plain text"),
          with_zeros("\xef\xbb\xbf text"), with_zeros("\xff\xfe\0\0a\0\0\0"), std::string(8, '\0'),
          with_zeros("\x01\0\x02\0\x03\0"), with_zeros("\xff\xd8\xff\xe0")})
        EXPECT_EQ(utf8_of_utf16(bytes), std::nullopt);
}

}  // namespace
}  // namespace coseg
