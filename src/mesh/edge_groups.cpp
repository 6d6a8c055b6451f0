#include "src/mesh/edge_groups.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "src/base/index.hpp"

namespace coseg {

EdgeGroups group_edges(const std::vector<int>& from, const std::vector<int>& to, int vertices) {
    std::vector<int> begin(at(vertices) + 1, 0);
    for (std::size_t h = 0; h < from.size(); ++h) {
        if (from[h] != to[h]) ++begin[at(std::min(from[h], to[h])) + 1];
    }
    for (std::size_t v = 1; v < begin.size(); ++v) begin[v] += begin[v - 1];
    // (higher vertex, half-edge).
    std::vector<std::pair<int, int>> by_lower(at(begin.back()));
    std::vector<int> next(begin.begin(), begin.end() - 1);
    for (std::size_t h = 0; h < from.size(); ++h) {
        if (from[h] == to[h]) continue;
        const auto lower = at(std::min(from[h], to[h]));
        by_lower[at(next[lower]++)] = {std::max(from[h], to[h]), static_cast<int>(h)};
    }
    EdgeGroups groups;
    groups.half_edges.reserve(by_lower.size());
    groups.offsets.reserve(by_lower.size() / 2 + 1);
    for (std::size_t v = 0; v + 1 < begin.size(); ++v) {
        const auto first = by_lower.begin() + begin[v];
        const auto last = by_lower.begin() + begin[v + 1];
        std::sort(first, last);
        for (auto entry = first; entry != last; ++entry) {
            const bool starts_group = entry == first || entry->first != std::prev(entry)->first;
            if (starts_group) groups.offsets.push_back(static_cast<int>(groups.half_edges.size()));
            groups.half_edges.push_back(entry->second);
        }
    }
    groups.offsets.push_back(static_cast<int>(groups.half_edges.size()));
    return groups;
}

}  // namespace coseg
