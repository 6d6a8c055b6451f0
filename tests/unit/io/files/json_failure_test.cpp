#include "io/files/json_failure.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

namespace coseg {
namespace {

std::string failure_of(const std::string& text) {
    try {
        return nlohmann::json::parse(text).dump();
    } catch (const nlohmann::json::exception& failure) {
        return json_failure(failure);
    }
}

TEST(JsonFailure, NamesThePlaceAndTheEndOfWhatWasRead) {
    const std::string cut = failure_of("{\n\"a\": \"\xC3\xBC'" + std::string(5000, 'x'));
    EXPECT_TRUE(cut.starts_with("parse error at line 2, column 5010: ")) << cut;
    EXPECT_TRUE(cut.ends_with("last read: '..." + std::string(80, 'x') + "'")) << cut;
    const std::string in_list = failure_of("[1 \"" + std::string(300, 'y'));
    EXPECT_TRUE(in_list.ends_with("..." + std::string(80, 'y') + "'; expected ']'")) << in_list;
    const std::string likewise = failure_of("{\"'; expected " + std::string(300, 'z'));
    EXPECT_TRUE(likewise.ends_with("last read: '..." + std::string(80, 'z') + "'; expected string literal"))
        << likewise;
    EXPECT_TRUE(failure_of("[\"a\xC3\x01").ends_with("last read: '\"a?<U+0001>'"))
        << failure_of("[\"a\xC3\x01");
}

TEST(JsonFailure, KeepsOtherSentences) {
    EXPECT_EQ(json_failure(std::runtime_error("key 'a' not found")), "key 'a' not found");
    EXPECT_EQ(json_failure(std::runtime_error("")), "");
    EXPECT_EQ(json_failure(std::runtime_error("last read: '")), "last read: '");
}

}  // namespace
}  // namespace coseg
