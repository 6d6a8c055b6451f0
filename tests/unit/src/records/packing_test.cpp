#include "src/records/packing.hpp"

#include <gtest/gtest.h>

#include "src/base/error.hpp"
#include "tests/support/every_kind.hpp"

namespace coseg {
namespace {

using test::changed_records;
using test::EveryKind;
using test::filled_record;

TEST(Packing, ARecordWithEveryKindOfFieldComesBack) {
    const std::vector<EveryKind> records = {filled_record(1), EveryKind{}, filled_record(2)};
    EXPECT_EQ(unpacked<std::vector<EveryKind>>(packed(records)), records);
}

TEST(Packing, EveryFieldIsCarried) {
    for (const EveryKind& changed : changed_records()) {
        EXPECT_NE(packed(changed), packed(filled_record(1)));
        EXPECT_EQ(unpacked<EveryKind>(packed(changed)), changed);
    }
}

struct WithCache {
    int value = 0;
    int cache = 0;
    static constexpr auto fields() {
        return std::tuple(field("value", &WithCache::value), local(&WithCache::cache));
    }
};

TEST(Packing, WhatIsLocalStaysWhereItIs) {
    WithCache other{.value = 1, .cache = 2};
    Unpacker(packed(WithCache{.value = 3, .cache = 4})).take(other);
    EXPECT_EQ(other.value, 3);
    EXPECT_EQ(other.cache, 2);
}

TEST(Packing, BytesThatEndTooEarlyAreRefused) {
    const std::vector<std::byte> bytes = packed(filled_record(1));
    for (std::size_t length = 0; length < bytes.size(); ++length) {
        EXPECT_THROW(unpacked<EveryKind>(std::span<const std::byte>(bytes).first(length)), Error) << length;
    }
}

}  // namespace
}  // namespace coseg
