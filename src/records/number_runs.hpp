#pragma once
// Numbers that follow each other and values that repeat, told by where they begin and end: what a person says
// of a hundred thousand faces is a few of these.

#include <cstdint>
#include <tuple>
#include <vector>

#include "src/records/fields.hpp"

namespace coseg {

/// The whole numbers from `first` to `last`, both included.
struct NumberRange {
    int first = 0;
    int last = 0;
    friend bool operator==(const NumberRange&, const NumberRange&) = default;
    static constexpr auto fields() {
        return std::tuple(field("first", &NumberRange::first), field("last", &NumberRange::last));
    }
};

/// A label that stands `count` times, one after the other.
struct LabelRun {
    int label = 0;
    int count = 0;
    friend bool operator==(const LabelRun&, const LabelRun&) = default;
    static constexpr auto fields() {
        return std::tuple(field("label", &LabelRun::label), field("count", &LabelRun::count));
    }
};

/// Ascending numbers as the fewest ranges.
std::vector<NumberRange> ranges_of(const std::vector<int>& ascending);
/// Whether a number lies in one of these ranges, which ascend.
bool contains(const std::vector<NumberRange>& ranges, int number);

/// Labels as the fewest runs.
std::vector<LabelRun> runs_of(const std::vector<int>& labels);
/// How many labels the runs stand for.
std::int64_t label_count(const std::vector<LabelRun>& runs);
/// The labels one by one: the inverse of `runs_of`.
std::vector<int> labels_of(const std::vector<LabelRun>& runs);

}  // namespace coseg
