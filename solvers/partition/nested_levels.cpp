#include "solvers/partition/nested_levels.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <numeric>
#include <utility>

#include "solvers/partition/partition_agreement.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

constexpr std::size_t ways_kept = 16;

/// Null where there is no partition into so many parts.
const std::vector<int>* guide_of(const PartitionsByNumber& guides, int parts) {
    const auto k = at(parts - 2);
    return k < guides.size() && !guides[k].empty() ? &guides[k] : nullptr;
}

/// Parts united two by two.
struct WayToUnite {
    std::vector<std::vector<int>> groups;  ///< of each part, one entry a level, from the finest
    double agreement = 0.0;                ///< sum over the levels
};

/// Rows of the same group as one.
Eigen::MatrixXd united_rows(const Eigen::MatrixXd& common, const std::vector<int>& group, int groups) {
    Eigen::MatrixXd united = Eigen::MatrixXd::Zero(groups, common.cols());
    for (std::size_t p = 0; p < group.size(); ++p) united.row(group[p]) += common.row(static_cast<int>(p));
    return united;
}

/// One level coarser, in the ways with the largest agreement. common: the areas that the parts share with the
/// guide of `groups` parts.
std::vector<WayToUnite> one_level_on(const std::vector<WayToUnite>& ways, const Eigen::MatrixXd& common,
                                     int groups) {
    std::vector<WayToUnite> next;
    for (const WayToUnite& way : ways) {
        for (int a = 0; a < groups; ++a) {
            for (int b = a + 1; b <= groups; ++b) {
                WayToUnite longer = way;
                std::vector<int> group = way.groups.back();
                for (int& g : group) g = g == b ? a : (g == groups ? b : g);
                longer.agreement += adjusted_rand_index(united_rows(common, group, groups));
                longer.groups.push_back(std::move(group));
                next.push_back(std::move(longer));
            }
        }
    }
    std::stable_sort(next.begin(), next.end(),
                     [](const WayToUnite& x, const WayToUnite& y) { return x.agreement > y.agreement; });
    if (next.size() > ways_kept) next.resize(ways_kept);
    return next;
}

/// The level of each number of parts below `parts`.
PartitionsByNumber coarser_levels(const std::vector<int>& part_of_patch, int parts,
                                  const PartitionsByNumber& guides, const std::vector<double>& patch_area) {
    std::vector<int> alone(at(parts));
    std::iota(alone.begin(), alone.end(), 0);
    std::vector<WayToUnite> ways = {{{alone}, 0.0}};
    for (int groups = parts - 1; groups >= 2; --groups)
        ways = one_level_on(
            ways, common_areas(part_of_patch, parts, *guide_of(guides, groups), groups, patch_area), groups);
    PartitionsByNumber levels;
    const std::vector<std::vector<int>>& groups = ways.front().groups;
    for (auto level = groups.rbegin(); level + 1 < groups.rend(); ++level) {
        std::vector<int> labels;
        for (const int part : part_of_patch) labels.push_back((*level)[at(part)]);
        levels.push_back(std::move(labels));
    }
    return levels;
}

/// What of a part lies in a part of a guide, and the agreement of the level that has it as a part of its own.
struct PartCutOut {
    int part = -1;
    int of_guide = -1;
    double agreement = -2.0;  ///< below that of any partition
};

PartCutOut best_cut(const Eigen::MatrixXd& common) {
    PartCutOut best;
    const Eigen::Index rows = common.rows();
    for (int p = 0; p < rows; ++p) {
        for (int g = 0; g < common.cols(); ++g) {
            if (common(p, g) <= 0.0 || common(p, g) >= common.row(p).sum()) continue;
            Eigen::MatrixXd after(rows + 1, common.cols());
            after.topRows(rows) = common;
            after.row(rows).setZero();
            after(rows, g) = std::exchange(after(p, g), 0.0);
            const double agreement = adjusted_rand_index(after);
            if (agreement > best.agreement) best = {p, g, agreement};
        }
    }
    return best;
}

}  // namespace

PartitionsByNumber nested_levels(const std::vector<int>& part_of_patch, int parts,
                                 const PartitionsByNumber& guides, const std::vector<double>& patch_area) {
    if (parts < 2) return {};
    for (int coarser = 2; coarser < parts; ++coarser) {
        if (guide_of(guides, coarser) == nullptr) return {};
    }
    PartitionsByNumber levels = coarser_levels(part_of_patch, parts, guides, patch_area);
    levels.push_back(part_of_patch);
    for (int finer = parts + 1; guide_of(guides, finer) != nullptr; ++finer) {
        const std::vector<int>& guide = *guide_of(guides, finer);
        std::vector<int> labels = levels.back();
        const PartCutOut cut = best_cut(common_areas(labels, finer - 1, guide, finer, patch_area));
        if (cut.part < 0) break;
        for (std::size_t i = 0; i < labels.size(); ++i) {
            if (labels[i] == cut.part && guide[i] == cut.of_guide) labels[i] = finer - 1;
        }
        levels.push_back(std::move(labels));
    }
    return levels;
}

}  // namespace coseg
