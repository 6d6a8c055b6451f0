#include "src/histograms/feature_range.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/histograms/hashed_sample.hpp"

namespace coseg {

namespace {

constexpr double low_percentile = 0.01;
constexpr double high_percentile = 0.99;

std::span<const double> span_of(const Eigen::VectorXd& values) { return {values.data(), at(values.size())}; }

void check_feature(int bins, std::span<const FeatureOfMesh> local) {
    if (bins < 1)
        throw Error(ExitCode::internal, "a feature needs at least one bin, not " + std::to_string(bins));
    for (const FeatureOfMesh& feature : local) {
        if (feature.values->size() != feature.weights->size()) {
            throw Error(ExitCode::internal, "a feature has " + std::to_string(feature.values->size()) +
                                                " values but " + std::to_string(feature.weights->size()) +
                                                " weights");
        }
        for (Eigen::Index f = 0; f < feature.values->size(); ++f) {
            if (std::isfinite((*feature.values)[f]) && std::isfinite((*feature.weights)[f])) continue;
            throw Error(ExitCode::input,
                        "a descriptor of face " + std::to_string(f) +
                            " is not a finite number; check the mesh for extreme coordinates");
        }
    }
}

std::vector<double> uniform_edges(double low, double high, int bins) {
    std::vector<double> edges(at(bins) + 1);
    for (int b = 0; b <= bins; ++b) edges[at(b)] = low + (high - low) * b / bins;
    edges.back() = high;
    return edges;
}

/// Values and weights of the sampled faces of all meshes, in the order of ranks.
struct Sample {
    std::vector<double> values;
    std::vector<double> weights;
};

Sample gather_sample(const Comm& comm, std::span<const FeatureOfMesh> local, std::uint64_t seed) {
    std::int64_t faces = 0;
    for (const FeatureOfMesh& feature : local) faces += feature.values->size();
    const double share = sampling_share(range_sample_faces, all_sum(comm, faces));
    Sample mine;
    for (const FeatureOfMesh& feature : local) {
        for (const int f :
             hashed_sample(seed, feature.mesh_key, static_cast<int>(feature.values->size()), share)) {
            mine.values.push_back((*feature.values)[f]);
            mine.weights.push_back((*feature.weights)[f]);
        }
    }
    return {all_gather(comm, std::span<const double>(mine.values)),
            all_gather(comm, std::span<const double>(mine.weights))};
}

std::vector<double> pooled_edges(RangeKind kind, int bins, const Sample& sample) {
    if (kind == RangeKind::global_percentile) {
        const auto ends =
            weighted_quantiles(sample.values, sample.weights, std::array{low_percentile, high_percentile});
        return uniform_edges(ends[0], ends[1], bins);
    }
    return weighted_quantiles(sample.values, sample.weights, uniform_edges(0.0, 1.0, bins));
}

}  // namespace

std::vector<double> weighted_quantiles(std::span<const double> values, std::span<const double> weights,
                                       std::span<const double> fractions) {
    // Equal values are ordered by weight, so that the sums below do not depend on the order of the input.
    std::vector<std::pair<double, double>> sorted(values.size());
    for (std::size_t i = 0; i < sorted.size(); ++i) sorted[i] = {values[i], weights[i]};
    std::sort(sorted.begin(), sorted.end());
    double total = 0.0;
    for (const auto& [value, weight] : sorted) total += weight;
    const bool has_weight = total > 0.0;
    if (!has_weight) total = static_cast<double>(sorted.size());
    std::vector<double> quantiles;
    std::size_t next = 0;
    double below = 0.0;
    for (const double fraction : fractions) {
        // Rounding of the running sum must not push a quantile past the value that completes the fraction.
        const double wanted = fraction * total - 1e-12 * total;
        while (next + 1 < sorted.size() && below + (has_weight ? sorted[next].second : 1.0) < wanted) {
            below += has_weight ? sorted[next].second : 1.0;
            ++next;
        }
        quantiles.push_back(fraction >= 1.0 ? sorted.back().first : sorted[next].first);
    }
    return quantiles;
}

FeatureRange agree_on_range(const Comm& comm, RangeKind kind, int bins, std::span<const FeatureOfMesh> local,
                            std::uint64_t seed) {
    agree(comm, [&] { check_feature(bins, local); });
    if (kind == RangeKind::per_mesh_percentile) return {kind, uniform_edges(0.0, 1.0, bins)};
    const Sample sample = gather_sample(comm, local, seed);
    if (sample.values.empty()) {
        throw AgreedError(ExitCode::input,
                          "the collection has no face to take a bin range from; list at least one mesh");
    }
    return {kind, pooled_edges(kind, bins, sample)};
}

void rescale_per_mesh(Eigen::VectorXd& values, const Eigen::VectorXd& area) {
    if (values.size() == 0) return;
    const auto ends =
        weighted_quantiles(span_of(values), span_of(area), std::array{low_percentile, high_percentile});
    const double spread = ends[1] - ends[0];
    const double rounding = 1e-12 + 1e-9 * std::max(std::abs(ends[0]), std::abs(ends[1]));
    if (!(spread > rounding)) {
        values.setZero();
        return;
    }
    for (double& value : values) value = std::clamp((value - ends[0]) / spread, 0.0, 1.0);
}

}  // namespace coseg
