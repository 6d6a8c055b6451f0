#include "src/base/text.hpp"

#include <gtest/gtest.h>

namespace coseg {
namespace {

TEST(Text, NumbersAsMessagesShowThem) {
    EXPECT_EQ(significant(0.0123456), "0.0123");
    EXPECT_EQ(significant(-1.5e-7), "-1.5e-07");
    EXPECT_EQ(significant(100.0), "100");
    EXPECT_EQ(decimal(2.0 / 3.0, 2), "0.67");
    EXPECT_EQ(decimal(-3.0, 0), "-3");
    EXPECT_EQ(decimal(0x1p200, 1), "1606938044258990275541962092341162602522202993782792835301376.0");
    EXPECT_EQ(percent(0.5, 0), "50 %");
    EXPECT_EQ(percent(0.12345, 1), "12.3 %");
}

TEST(Text, EscapedTextHoldsNothingThatMarkupReads) {
    EXPECT_EQ(escaped("a<b & \"c\">"), "a&lt;b &amp; &quot;c&quot;>");
    EXPECT_EQ(escaped(""), "");
}

TEST(Text, Utf8IsToldFromOtherBytes) {
    for (const char* text : {"", "plain", "\xc3\xa9", "\xe2\x82\xac", "\xf0\x9f\x98\x80", "\xf4\x8f\xbf\xbf"})
        EXPECT_TRUE(is_utf8(text)) << text;
    for (const char* bytes : {"caf\xe9", "\xc3", "\xc0\x80", "\xe0\x9f\xbf", "\xed\xa0\x80",
                              "\xf4\x90\x80\x80", "\xff", "\x80", "\xe2\x82", "\xf8\x88\x80\x80\x80"})
        EXPECT_FALSE(is_utf8(bytes)) << bytes;
}

TEST(Text, BytesComeBackFromTheirDigits) {
    std::string bytes;
    for (int k = 0; k < 256; ++k) bytes += static_cast<char>(k);
    EXPECT_EQ(bytes_of_hex(hex_of_bytes(bytes)), bytes);
    EXPECT_EQ(hex_of_bytes("caf\xe9"), "636166e9");
    EXPECT_EQ(bytes_of_hex("6361g6"), "ca");
    EXPECT_EQ(hex_unless_utf8("caf\xe9"), "636166e9");
    EXPECT_EQ(hex_unless_utf8("plain"), std::nullopt);
}

TEST(Text, OneThingIsNamedInTheSingular) {
    EXPECT_EQ(with_unit(0, "shape", "shapes"), "0 shapes");
    EXPECT_EQ(with_unit(1, "shape", "shapes"), "1 shape");
    EXPECT_EQ(with_unit(20, "vertex", "vertices"), "20 vertices");
}

TEST(Text, ReadsWholeNumbersAndNothingElse) {
    EXPECT_EQ(whole_number("0"), 0);
    EXPECT_EQ(whole_number("-12"), -12);
    EXPECT_EQ(whole_number("2147483647"), 2147483647);
    for (const char* bad : {"", " 1", "1 ", "+1", "1.0", "0x1", "2147483648", "-", "one"})
        EXPECT_FALSE(whole_number(bad).has_value()) << bad;
}

}  // namespace
}  // namespace coseg
