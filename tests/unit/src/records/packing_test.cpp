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

TEST(Packing, BytesThatEndTooEarlyAreRefused) {
    const std::vector<std::byte> bytes = packed(filled_record(1));
    for (std::size_t length = 0; length < bytes.size(); ++length) {
        EXPECT_THROW(unpacked<EveryKind>(std::span<const std::byte>(bytes).first(length)), Error) << length;
    }
}

}  // namespace
}  // namespace coseg
