#include "src/base/spelling.hpp"

#include <algorithm>
#include <numeric>

namespace coseg {

int edit_distance(const std::string& a, const std::string& b) {
    std::vector<int> row(b.size() + 1);
    std::iota(row.begin(), row.end(), 0);
    for (std::size_t i = 1; i <= a.size(); ++i) {
        int diagonal = row[0];
        row[0] = static_cast<int>(i);
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const int replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
        }
    }
    return row.back();
}

std::string nearest_word(const std::string& word, const std::vector<std::string>& candidates) {
    std::string nearest;
    int least = 0;
    for (const std::string& candidate : candidates) {
        const int distance = edit_distance(word, candidate);
        const auto allowed =
            static_cast<int>(std::max<std::size_t>(2, std::max(word.size(), candidate.size()) / 3));
        if (distance > allowed || (!nearest.empty() && distance >= least)) continue;
        nearest = candidate;
        least = distance;
    }
    return nearest;
}

}  // namespace coseg
