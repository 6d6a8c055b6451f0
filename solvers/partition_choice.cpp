#include "solvers/partition_choice.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "solvers/cluster_merging.hpp"
#include "src/rand_index.hpp"

namespace coseg {

namespace {

/// Adds weight * (term - mean) / deviation to each score.
void add_standardised(std::span<const PartitionTerms> partitions, double PartitionTerms::*term, double weight,
                      std::vector<double>& scores) {
    const auto count = static_cast<double>(partitions.size());
    double sum = 0.0;
    for (const PartitionTerms& p : partitions) sum += p.*term;
    const double mean = sum / count;
    double squares = 0.0;
    for (const PartitionTerms& p : partitions) squares += (p.*term - mean) * (p.*term - mean);
    const double deviation = std::sqrt(squares / count);
    // Partitions that agree but for rounding have no say: a deviation of 1e-15 would turn noise into a score.
    if (deviation <= 1e-12 * std::max(1.0, std::abs(mean))) return;
    for (std::size_t k = 0; k < scores.size(); ++k)
        scores[k] += weight * ((partitions[k].*term - mean) / deviation);
}

}  // namespace

double boundary_concavity(const std::vector<PatchRelation>& neighbors, const std::vector<int>& labels) {
    double length = 0.0;
    double concave = 0.0;
    for (const PatchRelation& pair : neighbors) {
        if (labels[static_cast<std::size_t>(pair.patch_a)] == labels[static_cast<std::size_t>(pair.patch_b)])
            continue;
        length += pair.boundary_length;
        concave += pair.boundary_length * pair.concavity;
    }
    return length > 0.0 ? concave / length : 0.0;
}

std::vector<double> mean_area_shares(const std::vector<int>& labels, int parts,
                                     const std::vector<double>& patch_area, const std::vector<int>& mesh_of) {
    const Eigen::MatrixXd of_mesh = area_shares(labels, parts, patch_area, mesh_of);
    std::vector<double> shares(static_cast<std::size_t>(parts), 0.0);
    for (int m = 0; m < of_mesh.cols(); ++m) {
        for (int p = 0; p < parts; ++p) shares[static_cast<std::size_t>(p)] += of_mesh(p, m);
    }
    for (double& share : shares) share /= static_cast<double>(of_mesh.cols());
    return shares;
}

double entropy(std::span<const double> shares) {
    double sum = 0.0;
    for (const double share : shares) {
        if (share > 0.0) sum -= share * std::log(share);
    }
    return sum;
}

double evenness(const Eigen::MatrixXd& shares) {
    const auto entropy_of = [](const Eigen::VectorXd& column) {
        return entropy({column.data(), static_cast<std::size_t>(column.size())});
    };
    double inside = 0.0;
    for (Eigen::Index m = 0; m < shares.cols(); ++m) inside += entropy_of(shares.col(m));
    return inside / static_cast<double>(shares.cols()) - entropy_of(shares.rowwise().mean());
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

std::vector<double> agreement(const std::vector<std::vector<int>>& partitions,
                              const std::vector<double>& patch_area) {
    const std::size_t count = partitions.size();
    if (count == 1) return {1.0};
    std::vector<double> mean(count, 0.0);
    for (std::size_t a = 0; a < count; ++a) {
        for (std::size_t b = a + 1; b < count; ++b) {
            const double common = adjusted_rand_index(partitions[a], partitions[b], patch_area);
            mean[a] += common / static_cast<double>(count - 1);
            mean[b] += common / static_cast<double>(count - 1);
        }
    }
    return mean;
}

std::vector<double> partition_scores(std::span<const PartitionTerms> partitions,
                                     const ChoiceWeights& weights) {
    std::vector<double> scores(partitions.size(), 0.0);
    if (partitions.empty()) return scores;
    add_standardised(partitions, &PartitionTerms::association, weights.association, scores);
    add_standardised(partitions, &PartitionTerms::concavity, weights.concavity, scores);
    add_standardised(partitions, &PartitionTerms::entropy, weights.entropy, scores);
    add_standardised(partitions, &PartitionTerms::evenness, weights.evenness, scores);
    return scores;
}

std::vector<int> canonical_labels(const std::vector<int>& labels, int parts,
                                  const std::vector<double>& patch_area, const std::vector<int>& mesh_of) {
    const std::vector<double> shares = mean_area_shares(labels, parts, patch_area, mesh_of);
    std::vector<std::size_t> lowest(shares.size(), labels.size());
    for (std::size_t i = labels.size(); i-- > 0;) lowest[static_cast<std::size_t>(labels[i])] = i;
    std::vector<int> order(shares.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](int a, int b) {
        const auto x = static_cast<std::size_t>(a);
        const auto y = static_cast<std::size_t>(b);
        const bool empty_x = lowest[x] == labels.size();
        const bool empty_y = lowest[y] == labels.size();
        if (empty_x != empty_y) return empty_y;
        if (shares[x] != shares[y]) return shares[x] > shares[y];
        return lowest[x] != lowest[y] ? lowest[x] < lowest[y] : a < b;
    });
    std::vector<int> number(shares.size());
    for (std::size_t k = 0; k < order.size(); ++k)
        number[static_cast<std::size_t>(order[k])] = static_cast<int>(k);
    std::vector<int> renamed(labels.size());
    for (std::size_t i = 0; i < labels.size(); ++i) renamed[i] = number[static_cast<std::size_t>(labels[i])];
    return renamed;
}

}  // namespace coseg
