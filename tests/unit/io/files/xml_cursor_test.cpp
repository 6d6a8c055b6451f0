#include "io/files/xml_cursor.hpp"

#include <gtest/gtest.h>

#include <string>

#include "src/base/error.hpp"
#include "tests/support/errors.hpp"

namespace coseg {
namespace {

TEST(XmlCursor, GivesTagsWithTheirAttributesAndTheTextBetween) {
    XmlCursor cursor("<?xml version='1.0'?>\n<a one=\"1 > 0\" two = 'x'><!-- <b> -->text<b/></a >rest",
                     "f.xml");
    // A '>' inside quotation marks ends no tag.
    std::optional<XmlTag> tag = cursor.next_tag();
    ASSERT_TRUE(tag);
    EXPECT_EQ(tag->name, "a");
    EXPECT_TRUE(tag->begins && !tag->ends);
    EXPECT_EQ(tag->attribute("one"), "1 > 0");
    EXPECT_EQ(tag->attribute("two"), "x");
    EXPECT_EQ(tag->attribute("three", "none"), "none");
    tag = cursor.next_tag();
    ASSERT_TRUE(tag);
    EXPECT_EQ(cursor.text_before_tag(), "text");
    EXPECT_TRUE(tag->name == "b" && tag->begins && tag->ends);
    tag = cursor.next_tag();
    ASSERT_TRUE(tag);
    EXPECT_TRUE(tag->name == "a" && !tag->begins && tag->ends);
    EXPECT_EQ(cursor.rest(), "rest");
    EXPECT_FALSE(cursor.next_tag());
    EXPECT_EQ(cursor.text_before_tag(), "rest");
}

TEST(XmlCursor, RefusesWhatIsCutShortOrNotUnderstood) {
    const auto sentence = [](const std::string& text) {
        return test::error_of([&] {
                   XmlCursor cursor(text, "f.xml");
                   while (cursor.next_tag()) {
                   }
               })
            .sentence;
    };
    EXPECT_TRUE(sentence("<a>\n<b c=\"1\"").starts_with("f.xml:2: a tag is cut short"));
    EXPECT_TRUE(sentence("<a>\n<b c=\"1>").starts_with("f.xml:2: a tag is cut short"));
    EXPECT_TRUE(sentence("<>").starts_with("f.xml:1: a tag has no name"));
    EXPECT_TRUE(sentence("<a b>").starts_with("f.xml:1: the tag 'a' has an attribute without a value"));
    EXPECT_TRUE(sentence("<a b=1>").starts_with("f.xml:1: the tag 'a' has an attribute without a value"));
    EXPECT_TRUE(sentence("<!DOCTYPE a>").starts_with("f.xml:1: declarations of XML"));
    EXPECT_TRUE(sentence("<? a").starts_with("f.xml:1: '<?' is not ended"));
    EXPECT_EQ(sentence("no tag"), "");
}

}  // namespace
}  // namespace coseg
