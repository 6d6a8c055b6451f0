#include "io/files/xml_cursor.hpp"

#include <gtest/gtest.h>

#include <string>

#include "src/base/error.hpp"
#include "tests/support/errors.hpp"

namespace coseg {
namespace {

TEST(XmlCursor, GivesTagsWithTheirAttributesAndTheTextBetween) {
    XmlCursor cursor("<?xml version='1.0'?>\n<a one=\"1 > 0\" two = 'x'><!-- <b> -->text<b/></a >\xff rest",
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
    EXPECT_EQ(cursor.rest(), "\xff rest");
    EXPECT_EQ(test::error_of([&] { cursor.next_tag(); }).sentence.substr(0, 27),
              "f.xml:2: the XML is damaged");
}

TEST(XmlCursor, EndsBehindTheRoot) {
    XmlCursor cursor("<a>&lt;</a>\n<!-- c -->", "f.xml");
    ASSERT_TRUE(cursor.next_tag());
    ASSERT_TRUE(cursor.next_tag());
    EXPECT_EQ(cursor.text_before_tag(), "&lt;") << "as it stands there";
    EXPECT_FALSE(cursor.next_tag());
    EXPECT_FALSE(cursor.next_tag());
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
    for (const char* cut : {"<a>\n<b c=\"1\"", "<a>\n<b c=\"1>", "<a>\n<!-- b", "<a>\n<?b "})
        EXPECT_TRUE(sentence(cut).starts_with("f.xml:2: the XML is cut short")) << sentence(cut);
    for (const char* cut : {"", "<a>", "<a/"})
        EXPECT_TRUE(sentence(cut).starts_with("f.xml:1: the XML is cut short")) << sentence(cut);
    for (const char* damaged :
         {"\n<>", "\n<a b>", "\n<a b=1>", "\nno tag", "<a>\n</b>", "<a/>\n<b/>", "\n<a>&b;</a>"})
        EXPECT_TRUE(sentence(damaged).starts_with("f.xml:2: the XML is damaged (")) << sentence(damaged);
    EXPECT_TRUE(
        sentence("\n<!DOCTYPE a [<!ENTITY b \"c\">]><a/>").starts_with("f.xml:2: declarations of XML"));
}

}  // namespace
}  // namespace coseg
