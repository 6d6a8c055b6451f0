#include "io/files/record_hash.hpp"

#include <gtest/gtest.h>

#include <set>

#include "tests/support/every_kind.hpp"

namespace coseg {
namespace {

using test::changed_records;
using test::EveryKind;
using test::filled_record;

template <class T>
std::string hash_of(const T& value) {
    ContentHasher hasher;
    add_value(hasher, value);
    return hasher.result().hex();
}

TEST(RecordHash, EveryFieldCounts) {
    EXPECT_EQ(hash_of(filled_record(1)), hash_of(filled_record(1)));
    std::set<std::string> seen = {hash_of(filled_record(1))};
    for (const EveryKind& changed : changed_records()) EXPECT_TRUE(seen.insert(hash_of(changed)).second);
}

TEST(RecordHash, WhatMovesFromOneFieldToTheNextCounts) {
    const std::vector<std::string> joined = {"ab", ""};
    const std::vector<std::string> parted = {"a", "b"};
    EXPECT_NE(hash_of(joined), hash_of(parted));
}

}  // namespace
}  // namespace coseg
