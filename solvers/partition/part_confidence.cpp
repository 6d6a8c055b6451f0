#include "solvers/partition/part_confidence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "solvers/choice/part_gains.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

constexpr double at_nothing = -7.84;
constexpr double of_margin = 1.26;
constexpr double of_ties = 10.0;
constexpr double margin_unit = 60.0;

/// What the part gains more than the best of the others.
double margin_of(const Eigen::VectorXd& gains, int part) {
    double best = -std::numeric_limits<double>::infinity();
    for (Eigen::Index other = 0; other < gains.size(); ++other) {
        if (other != part) best = std::max(best, gains(other));
    }
    return gains(part) - best;
}

/// 1 where there are no ties.
double share_of_ties(const PartitionObjective& objective, int patch, const std::vector<int>& labels) {
    double inside = 0.0;
    double all = 0.0;
    for_each_tie(objective, patch, [&](int other, double gain) {
        all += gain;
        inside += labels[at(other)] == labels[at(patch)] ? gain : 0.0;
    });
    return all > 0.0 ? inside / all : 1.0;
}

}  // namespace

std::vector<double> part_confidence(const PartitionObjective& objective, const KnownParts& known,
                                    const std::vector<int>& labels, int parts) {
    const PartGains all_gains(objective, labels, parts);
    const double total = std::accumulate(objective.area.begin(), objective.area.end(), 0.0);
    std::vector<double> confidence(labels.size(), 1.0);
    for (const BlockRange patches : patches_of_meshes(objective)) {
        Eigen::MatrixXd gains = all_gains.of_mesh(patches);
        if (known.gain.size() > 0) gains += known.gain.middleCols(patches.begin, patches.size());
        for (auto i = patches.begin; i < patches.end; ++i) {
            const double area = objective.area[at(i)];
            if (area <= 0.0 || (!known.fixed.empty() && known.fixed[at(i)] >= 0)) continue;
            const double margin = margin_of(gains.col(i - patches.begin), labels[at(i)]) * total / area;
            const double ties = share_of_ties(objective, static_cast<int>(i), labels);
            const double sum = at_nothing + of_margin * std::tanh(margin / margin_unit) + of_ties * ties;
            confidence[at(i)] = 1.0 / (1.0 + std::exp(-sum));
        }
    }
    return confidence;
}

}  // namespace coseg
