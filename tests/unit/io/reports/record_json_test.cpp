#include "io/reports/record_json.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/support/every_kind.hpp"

namespace coseg {
namespace {

using test::changed_records;
using test::EveryKind;
using test::filled_record;

template <class T>
std::string json_of(const T& value) {
    JsonTree tree;
    set_json(tree.root(), value);
    return tree.line();
}

TEST(RecordJson, SaysEveryKindOfField) {
    const auto json = nlohmann::ordered_json::parse(json_of(filled_record(1)));
    const auto expected =
        nlohmann::ordered_json::parse(R"({"truth": true, "small": -1, "large": 1099511627776,
        "hash": 18446744073709551615, "real": 0.1, "single": 0.5, "metal": "copper",
        "nested": {"name": "näme 1", "values": [1.0, 2.5]}, "counts": [7, 7], "truths": [true, false, true],
        "texts": ["", "two\nlines", "three"], "lists": [[1, 2], [], [3]],
        "rows": [{"name": "a", "values": []}, {"name": "b", "values": [4.0]}],
        "settings": [["seed", "1"], ["remesh", "auto"]], "triple": [1.0, 2.0, 3.0], "maybe": 0.25, "pair": [1, 2.0],
        "matrix": [[1.5, 1.5], [1.5, 1.5], [1.5, -4.0]], "vector": [1.0, 0.0, -1.0],
        "matrices": [[[1.0], [1.0]], [[], [], [], [], []]]})");
    EXPECT_EQ(json.dump(1), expected.dump(1));
}

TEST(RecordJson, EveryFieldIsSaid) {
    std::set<std::string> seen = {json_of(filled_record(1))};
    for (const EveryKind& changed : changed_records()) EXPECT_TRUE(seen.insert(json_of(changed)).second);
}

TEST(RecordJson, ALiteralIsAText) {
    JsonTree tree;
    tree.root().member("format").set("coseg report 1");
    EXPECT_EQ(tree.line(), R"({"format":"coseg report 1"})");
}

TEST(RecordJson, WhatIsNotThereOrNotFiniteIsNull) {
    EXPECT_EQ(json_of(std::optional<int>{}), "null");
    EXPECT_EQ(json_of(std::vector<double>{std::numeric_limits<double>::infinity()}), "[null]");
}

}  // namespace
}  // namespace coseg
