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

}  // namespace
}  // namespace coseg
