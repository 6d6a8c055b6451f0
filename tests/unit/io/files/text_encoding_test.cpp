#include "io/files/text_encoding.hpp"

#include <gtest/gtest.h>

namespace coseg {
namespace {

using std::string_literals::operator""s;

TEST(TextEncoding, Utf16BecomesUtf8) {
    EXPECT_EQ(utf8_of_utf16("\xff\xfe"s + "a\0b\0"s), "ab");
    EXPECT_EQ(utf8_of_utf16("\xfe\xff"s + "\0a\0b"s), "ab");
    EXPECT_EQ(utf8_of_utf16("a\0b\0\n\0"s), "ab\n");
    EXPECT_EQ(utf8_of_utf16("\xff\xfe\xe4\x00\xac\x20\x3d\xd8\x00\xde"s),
              "\xc3\xa4\xe2\x82\xac\xf0\x9f\x98\x80");
    EXPECT_EQ(utf8_of_utf16("\xff\xfe\x3d\xd8"s + "a\0"s), "\xef\xbf\xbd"s + "a");
}

TEST(TextEncoding, OtherBytesAreNotTouched) {
    for (const std::string& bytes :
         {""s, "a"s, "ab"s, "plain text"s, "\xef\xbb\xbf text"s, "\xff\xfe\0\0a\0\0\0"s, std::string(8, '\0'),
          "\x01\0\x02\0\x03\0"s, "\xff\xd8\xff\xe0"s})
        EXPECT_EQ(utf8_of_utf16(bytes), std::nullopt);
}

}  // namespace
}  // namespace coseg
