#include "src/metrics/rand_index.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace coseg {
namespace {

using Cell = std::pair<int, int>;  // label, truth label

/// Sums of squares of a table's cells, of its rows and of its columns.
struct PairSums {
    double together_in_both = 0.0;
    double together_in_labels = 0.0;
    double together_in_truth = 0.0;
    double total = 0.0;
};

PairSums pair_sums(const std::map<Cell, double>& weights) {
    PairSums sums;
    std::map<int, double> in_cluster;
    std::map<int, double> in_truth;
    for (const auto& [cell, weight] : weights) {
        sums.together_in_both += weight * weight;
        sums.total += weight;
        in_cluster[cell.first] += weight;
        in_truth[cell.second] += weight;
    }
    for (const auto& [label, weight] : in_cluster) sums.together_in_labels += weight * weight;
    for (const auto& [label, weight] : in_truth) sums.together_in_truth += weight * weight;
    return sums;
}

/// Ordered pairs together in one segmentation and apart in the other; rounding makes it no less than 0.
double disagreement(const PairSums& sums) {
    return std::max(sums.together_in_labels + sums.together_in_truth - 2.0 * sums.together_in_both, 0.0);
}

}  // namespace

double rand_index(const std::vector<int>& truth, const std::vector<int>& labels,
                  const std::vector<double>& weight) {
    std::map<Cell, double> weights;
    for (std::size_t item = 0; item < truth.size(); ++item) {
        if (truth[item] >= 0) weights[{labels[item], truth[item]}] += weight[item];
    }
    const PairSums sums = pair_sums(weights);
    return sums.total > 0.0 ? 1.0 - disagreement(sums) / (sums.total * sums.total) : 0.0;
}

double rand_index(const std::vector<int>& truth, const std::vector<int>& labels) {
    std::map<Cell, double> counts;
    for (std::size_t item = 0; item < truth.size(); ++item) {
        if (truth[item] >= 0) counts[{labels[item], truth[item]}] += 1.0;
    }
    const PairSums sums = pair_sums(counts);
    if (sums.total <= 1.0) return sums.total;
    return 1.0 - disagreement(sums) / (sums.total * (sums.total - 1.0));
}

}  // namespace coseg
