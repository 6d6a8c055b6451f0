#include "solvers/partition/partition_choice.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>

#include "solvers/partition/cluster_merging.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

struct Spread {
    double mean = 0.0;
    double deviation = 0.0;
};

Spread spread_of(std::span<const double> values) {
    const auto count = static_cast<double>(values.size());
    Spread spread;
    for (const double value : values) spread.mean += value;
    spread.mean /= count;
    for (const double value : values) spread.deviation += (value - spread.mean) * (value - spread.mean);
    spread.deviation = std::sqrt(spread.deviation / count);
    return spread;
}

/// Adds weight * (value - mean) / deviation to each score; a deviation of at least `least` is taken.
void add_standardised(std::span<const double> values, double weight, double least,
                      std::vector<double>& scores) {
    const Spread spread = spread_of(values);
    // Partitions that agree but for rounding have no say: a deviation of 1e-15 would turn noise into a score.
    const double rounding = 1e-12 * std::max(1.0, std::abs(spread.mean));
    if (spread.deviation <= rounding) return;
    const double deviation = std::max(spread.deviation, least);
    for (std::size_t k = 0; k < scores.size(); ++k)
        scores[k] += weight * ((values[k] - spread.mean) / deviation);
}

template <class Term>
std::vector<double> values_of(std::span<const PartitionTerms> partitions, Term term) {
    std::vector<double> values;
    for (const PartitionTerms& p : partitions) values.push_back(term(p));
    return values;
}

double median_of(std::span<const double> values) {
    std::vector<double> sorted(values.begin(), values.end());
    std::sort(sorted.begin(), sorted.end());
    const std::size_t half = sorted.size() / 2;
    return sorted.size() % 2 == 1 ? sorted[half] : 0.5 * (sorted[half - 1] + sorted[half]);
}

/// Partitions of those that are eligible whose scores come within `margin` of the best; in ascending order.
std::vector<std::size_t> short_list(std::span<const double> scores, const std::vector<bool>& eligible,
                                    double margin) {
    double best = -std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < scores.size(); ++k) {
        if (eligible[k]) best = std::max(best, scores[k]);
    }
    const double least = best - margin * std::max(0.0, best - median_of(scores));
    std::vector<std::size_t> list;
    for (std::size_t k = 0; k < scores.size(); ++k) {
        if (eligible[k] && scores[k] >= least) list.push_back(k);
    }
    return list;
}

/// Share of the deviation over all partitions below which differences inside the short list are not
/// magnified.
constexpr double least_share = 0.15;

/// Histograms weighted by area and summed over the patches of each part in each mesh.
struct HistogramSums {
    Eigen::MatrixXd histograms;  ///< bins x (parts * meshes): column mesh * parts + part
    Eigen::MatrixXd area;        ///< parts x meshes
    double squares = 0.0;        ///< sum over patches of area |x|^2
};

HistogramSums sums_of_parts(const Eigen::MatrixXf& histograms, const std::vector<int>& labels, int parts,
                            const std::vector<double>& patch_area, const std::vector<int>& mesh_of) {
    const int meshes = mesh_of.empty() ? 0 : *std::max_element(mesh_of.begin(), mesh_of.end()) + 1;
    HistogramSums sums{Eigen::MatrixXd::Zero(histograms.rows(), Eigen::Index{parts} * meshes),
                       Eigen::MatrixXd::Zero(parts, meshes)};
    for (std::size_t i = 0; i < labels.size(); ++i) {
        const auto x = histograms.col(static_cast<Eigen::Index>(i)).cast<double>();
        sums.histograms.col(Eigen::Index{mesh_of[i]} * parts + labels[i]) += patch_area[i] * x;
        sums.area(labels[i], mesh_of[i]) += patch_area[i];
        sums.squares += patch_area[i] * x.squaredNorm();
    }
    return sums;
}

/// Whether the links of each row of this rank weigh more on the row's own part than on any other.
std::vector<int> rows_matched(const SparseRows& links, const std::vector<int>& labels, int parts) {
    std::vector<int> matched;
    std::vector<double> weight(at(parts));
    for (std::size_t r = 0; r < at(links.local_rows()); ++r) {
        std::fill(weight.begin(), weight.end(), 0.0);
        for (auto k = at(links.offsets[r]); k < at(links.offsets[r + 1]); ++k) {
            const int part = labels[at(links.columns[k])];
            weight[at(part)] += links.values[k];
        }
        const auto heaviest = std::max_element(weight.begin(), weight.end()) - weight.begin();
        const int own = labels[at(links.rows.begin) + r];
        matched.push_back(heaviest == own ? 1 : 0);
    }
    return matched;
}

}  // namespace

double boundary_concavity(const std::vector<GlobalPatchNeighbors>& neighbors,
                          const std::vector<int>& labels) {
    double length = 0.0;
    double concave = 0.0;
    for (const GlobalPatchNeighbors& pair : neighbors) {
        if (labels[at(pair.patch_a)] == labels[at(pair.patch_b)]) continue;
        length += pair.boundary_length;
        concave += pair.boundary_length * pair.concavity;
    }
    return length > 0.0 ? concave / length : 0.0;
}

std::vector<double> mean_area_shares(const std::vector<int>& labels, int parts,
                                     const std::vector<double>& patch_area, const std::vector<int>& mesh_of) {
    const Eigen::MatrixXd of_mesh = area_shares(labels, parts, patch_area, mesh_of);
    std::vector<double> shares(at(parts), 0.0);
    for (int m = 0; m < of_mesh.cols(); ++m) {
        for (int p = 0; p < parts; ++p) shares[at(p)] += of_mesh(p, m);
    }
    for (double& share : shares) share /= static_cast<double>(of_mesh.cols());
    return shares;
}

double presence(const Eigen::MatrixXd& shares) {
    constexpr double least = 0.25;
    std::int64_t present = 0;
    for (Eigen::Index p = 0; p < shares.rows(); ++p) {
        const double mean = shares.row(p).mean();
        for (Eigen::Index m = 0; m < shares.cols() && mean > 0.0; ++m) {
            if (shares(p, m) >= least * mean) ++present;
        }
    }
    return static_cast<double>(present) / static_cast<double>(shares.size());
}

double boundary_crease(const std::vector<GlobalPatchNeighbors>& neighbors, const std::vector<int>& labels,
                       int meshes) {
    double cost = 0.0;
    for (const GlobalPatchNeighbors& pair : neighbors) {
        if (labels[at(pair.patch_a)] == labels[at(pair.patch_b)]) continue;
        const double flat = 1.0 - std::clamp(pair.concavity, 0.0, 1.0);
        cost += pair.boundary_length * flat * flat;
    }
    return -cost / static_cast<double>(meshes);
}

double overlap_agreement(const std::vector<GlobalPatchOverlap>& overlaps, const std::vector<int>& labels,
                         const std::vector<double>& patch_area) {
    std::vector<double> all(labels.size(), 0.0);
    std::vector<double> own(labels.size(), 0.0);
    for (const GlobalPatchOverlap& pair : overlaps) {
        const auto a = at(pair.patch_a);
        const auto b = at(pair.patch_b);
        for (const std::size_t i : {a, b}) {
            all[i] += pair.intersection_over_union;
            if (labels[a] == labels[b]) own[i] += pair.intersection_over_union;
        }
    }
    double agreed = 0.0;
    double area = 0.0;
    for (std::size_t i = 0; i < labels.size(); ++i) {
        if (all[i] <= 0.0) continue;
        agreed += patch_area[i] * (own[i] / all[i]);
        area += patch_area[i];
    }
    return area > 0.0 ? agreed / area : 1.0;
}

double link_consistency(const Comm& comm, const SparseRows& links, const std::vector<int>& labels, int parts,
                        const std::vector<double>& patch_area) {
    std::vector<int> matched = rows_matched(links, labels, parts);
    if (comm.size() > 1) matched = all_gather(comm, std::span<const int>(matched));
    std::vector<double> area(at(parts), 0.0);
    std::vector<double> found(at(parts), 0.0);
    for (std::size_t i = 0; i < labels.size(); ++i) {
        area[at(labels[i])] += patch_area[i];
        if (matched[i] == 1) found[at(labels[i])] += patch_area[i];
    }
    double sum = 0.0;
    for (std::size_t p = 0; p < area.size(); ++p) sum += area[p] > 0.0 ? found[p] / area[p] : 0.0;
    return sum / static_cast<double>(parts);
}

BetweenPartVariance between_part_variance(const Eigen::MatrixXf& histograms, const std::vector<int>& labels,
                                          int parts, const std::vector<double>& patch_area,
                                          const std::vector<int>& mesh_of) {
    const HistogramSums sums = sums_of_parts(histograms, labels, parts, patch_area, mesh_of);
    const Eigen::Index meshes = sums.area.cols();
    Eigen::MatrixXd deviations = Eigen::MatrixXd::Zero(histograms.rows(), parts);
    double of_means = 0.0;
    double per_mesh = 0.0;
    for (Eigen::Index m = 0; m < meshes; ++m) {
        const double area = sums.area.col(m).sum();
        if (!(area > 0.0)) continue;
        const auto of_mesh = sums.histograms.middleCols(m * parts, parts);
        const Eigen::VectorXd mean = of_mesh.rowwise().sum() / area;
        of_means += area * mean.squaredNorm();
        for (int p = 0; p < parts; ++p) {
            const double a = sums.area(p, m);
            if (!(a > 0.0)) continue;
            const Eigen::VectorXd deviation = of_mesh.col(p) - a * mean;
            per_mesh += deviation.squaredNorm() / a;
            deviations.col(p) += deviation;
        }
    }
    const double spread = sums.squares - of_means;
    if (!(spread > 1e-12 * sums.squares)) return {};
    double pooled = 0.0;
    for (int p = 0; p < parts; ++p) {
        const double a = sums.area.row(p).sum();
        if (a > 0.0) pooled += deviations.col(p).squaredNorm() / a;
    }
    return {.pooled = std::clamp(pooled / spread, 0.0, 1.0),
            .per_mesh = std::clamp(per_mesh / spread, 0.0, 1.0)};
}

PartitionTerms partition_terms(const Comm& comm, const PartitionEvidence& evidence,
                               const std::vector<int>& labels, int parts) {
    const Eigen::MatrixXd shares = area_shares(labels, parts, evidence.patch_area, evidence.mesh_of);
    PartitionTerms terms;
    terms.crease = boundary_crease(evidence.neighbors, labels, static_cast<int>(shares.cols()));
    terms.overlap = overlap_agreement(evidence.overlaps, labels, evidence.patch_area);
    for (const ChoiceDescriptor& d : evidence.descriptors)
        terms.explained.push_back(
            between_part_variance(d.histograms, labels, parts, evidence.patch_area, evidence.mesh_of));
    terms.concavity = boundary_concavity(evidence.neighbors, labels);
    terms.presence = presence(shares);
    terms.link_consistency = link_consistency(comm, evidence.links, labels, parts, evidence.patch_area);
    return terms;
}

std::vector<double> partition_scores(std::span<const PartitionTerms> partitions, const ChoiceWeights& weights,
                                     std::span<const BetweenPartVariance> descriptor_weights) {
    std::vector<double> scores(partitions.size(), 0.0);
    if (partitions.empty()) return scores;
    const auto add = [&](double weight, double least, const auto& term) {
        add_standardised(values_of(partitions, term), weight, least, scores);
    };
    add(weights.crease, weights.least_crease, [](const PartitionTerms& p) { return p.crease; });
    add(weights.overlap, weights.least_overlap, [](const PartitionTerms& p) { return p.overlap; });
    for (std::size_t h = 0; h < descriptor_weights.size(); ++h) {
        add(descriptor_weights[h].pooled, weights.least_explained,
            [h](const PartitionTerms& p) { return p.explained[h].pooled; });
        add(descriptor_weights[h].per_mesh, weights.least_explained,
            [h](const PartitionTerms& p) { return p.explained[h].per_mesh; });
    }
    return scores;
}

std::size_t best_partition(std::span<const PartitionTerms> partitions, std::span<const double> scores,
                           const std::vector<bool>& eligible, const ChoiceWeights& weights) {
    const std::vector<std::size_t> list = short_list(scores, eligible, weights.margin);
    std::vector<double> merit;
    for (const std::size_t k : list) merit.push_back(weights.score * scores[k]);
    const auto add = [&](double weight, const auto& term) {
        const std::vector<double> all = values_of(partitions, term);
        std::vector<double> listed;
        for (const std::size_t k : list) listed.push_back(all[k]);
        add_standardised(listed, weight, least_share * spread_of(all).deviation, merit);
    };
    add(weights.concavity, [](const PartitionTerms& p) { return p.concavity; });
    add(weights.presence, [](const PartitionTerms& p) { return p.presence; });
    add(weights.link_consistency, [](const PartitionTerms& p) { return p.link_consistency; });
    return list[at(std::max_element(merit.begin(), merit.end()) - merit.begin())];
}

std::vector<int> canonical_labels(const std::vector<int>& labels, int parts,
                                  const std::vector<double>& patch_area, const std::vector<int>& mesh_of) {
    const std::vector<double> shares = mean_area_shares(labels, parts, patch_area, mesh_of);
    std::vector<std::size_t> lowest(shares.size(), labels.size());
    for (std::size_t i = labels.size(); i-- > 0;) lowest[at(labels[i])] = i;
    std::vector<int> order(shares.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](int a, int b) {
        const auto x = at(a);
        const auto y = at(b);
        const bool empty_x = lowest[x] == labels.size();
        const bool empty_y = lowest[y] == labels.size();
        if (empty_x != empty_y) return empty_y;
        if (shares[x] != shares[y]) return shares[x] > shares[y];
        return lowest[x] != lowest[y] ? lowest[x] < lowest[y] : a < b;
    });
    std::vector<int> number(shares.size());
    for (std::size_t k = 0; k < order.size(); ++k) number[at(order[k])] = static_cast<int>(k);
    std::vector<int> renamed(labels.size());
    for (std::size_t i = 0; i < labels.size(); ++i) renamed[i] = number[at(labels[i])];
    return renamed;
}

}  // namespace coseg
