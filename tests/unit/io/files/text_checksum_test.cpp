#include "io/files/text_checksum.hpp"

#include <gtest/gtest.h>

#include "io/files/content_hash.hpp"

namespace coseg {
namespace {

const std::string blank = "{\n  \"format\": \"a\",\n  \"text_xxh3\": \"" + std::string(blank_checksum) +
                          "\",\n  \"share\": 0.25\n}\n";

TEST(TextChecksum, IsThatOfTheTextWithZeros) {
    const std::string text = with_checksum(blank);
    const std::size_t place = text.find(hash_bytes(blank).hex());
    EXPECT_EQ(place, blank.find(blank_checksum));
    EXPECT_EQ(text.size(), blank.size());
    EXPECT_TRUE(has_right_checksum(text));
    EXPECT_FALSE(has_right_checksum(blank));
}

TEST(TextChecksum, TextsWithoutOneAreNotRight) {
    EXPECT_EQ(with_checksum("{}"), "{}");
    EXPECT_FALSE(has_right_checksum("{\"format\": \"a\"}"));
}

TEST(TextChecksum, FindsEveryFlippedBit) {
    const std::string text = with_checksum(blank);
    for (std::size_t byte = 0; byte < text.size(); ++byte) {
        for (int bit = 0; bit < 8; ++bit) {
            std::string flipped = text;
            flipped[byte] = static_cast<char>(flipped[byte] ^ (1 << bit));
            EXPECT_FALSE(has_right_checksum(flipped)) << byte << " " << bit;
        }
    }
}

TEST(TextChecksum, ShortAndLongTexts) {
    const std::string text = with_checksum(blank);
    EXPECT_FALSE(has_right_checksum(text.substr(0, text.find("\"share\""))));
    EXPECT_FALSE(has_right_checksum(text.substr(0, text.find(hash_bytes(blank).hex()) + 5)));
    EXPECT_FALSE(has_right_checksum(text + "\n"));
}

}  // namespace
}  // namespace coseg
