#include "src/records/number_runs.hpp"

#include <algorithm>
#include <iterator>

#include "src/base/index.hpp"

namespace coseg {

std::vector<NumberRange> ranges_of(const std::vector<int>& ascending) {
    std::vector<NumberRange> ranges;
    for (const int number : ascending) {
        if (!ranges.empty() && number == ranges.back().last + 1)
            ranges.back().last = number;
        else
            ranges.push_back({number, number});
    }
    return ranges;
}

bool contains(const std::vector<NumberRange>& ranges, int number) {
    const auto after = std::upper_bound(ranges.begin(), ranges.end(), number,
                                        [](int n, const NumberRange& range) { return n < range.first; });
    return after != ranges.begin() && number <= std::prev(after)->last;
}

std::vector<LabelRun> runs_of(const std::vector<int>& labels) {
    std::vector<LabelRun> runs;
    for (const int label : labels) {
        if (!runs.empty() && label == runs.back().label)
            ++runs.back().count;
        else
            runs.push_back({label, 1});
    }
    return runs;
}

std::int64_t label_count(const std::vector<LabelRun>& runs) {
    std::int64_t count = 0;
    for (const LabelRun& run : runs) count += run.count;
    return count;
}

std::vector<int> labels_of(const std::vector<LabelRun>& runs) {
    std::vector<int> labels;
    for (const LabelRun& run : runs) labels.insert(labels.end(), at(run.count), run.label);
    return labels;
}

}  // namespace coseg
