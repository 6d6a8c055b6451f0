#include "solvers/subspace/feature_strength.hpp"

#include <cmath>
#include <numeric>
#include <span>

#include "src/base/index.hpp"

namespace coseg {

namespace {

/// Per owned column 2H sums over its pairs: of all of them, then of those inside the column's part.
std::vector<double> column_sums(const SparseCoefficients& coefficients,
                                const std::vector<int>& part_of_patch) {
    const auto features = at(coefficients.features);
    std::vector<double> sums(at(coefficients.columns.size()) * 2 * features, 0.0);
    for (std::size_t c = 0; c < at(coefficients.columns.size()); ++c) {
        const int part = part_of_patch[at(coefficients.columns.begin) + c];
        double* const all = sums.data() + c * 2 * features;
        const auto end = at(coefficients.offsets[c + 1]);
        for (auto k = at(coefficients.offsets[c]); k < end; ++k) {
            const bool same_part = part_of_patch[at(coefficients.rows[k])] == part;
            for (std::size_t h = 0; h < features; ++h) {
                const double w = std::abs(coefficients.values[k * features + h]);
                all[h] += w;
                if (same_part) all[features + h] += w;
            }
        }
    }
    return sums;
}

/// Per owned column, per part of the row: the sum over its pairs of ||w_ij||_2.
std::vector<double> column_blocks(const SparseCoefficients& coefficients,
                                  const std::vector<int>& part_of_patch, std::size_t parts) {
    const auto features = at(coefficients.features);
    std::vector<double> sums(at(coefficients.columns.size()) * parts, 0.0);
    for (std::size_t c = 0; c < at(coefficients.columns.size()); ++c) {
        const auto end = at(coefficients.offsets[c + 1]);
        for (auto k = at(coefficients.offsets[c]); k < end; ++k) {
            double squares = 0.0;
            for (std::size_t h = 0; h < features; ++h) {
                const double w = coefficients.values[k * features + h];
                squares += w * w;
            }
            const int part = part_of_patch[at(coefficients.rows[k])];
            sums[c * parts + at(part)] += std::sqrt(squares);
        }
    }
    return sums;
}

std::vector<std::vector<double>> block_structure(const Comm& comm, const SparseCoefficients& coefficients,
                                                 const std::vector<int>& part_of_patch, std::size_t parts) {
    const std::vector<double> sums =
        all_gather(comm, std::span<const double>(column_blocks(coefficients, part_of_patch, parts)));
    std::vector<double> blocks(parts * parts, 0.0);
    double total = 0.0;
    for (std::size_t j = 0; j < part_of_patch.size(); ++j) {
        for (std::size_t row = 0; row < parts; ++row) {
            blocks[row * parts + at(part_of_patch[j])] += sums[j * parts + row];
            total += sums[j * parts + row];
        }
    }
    std::vector<std::vector<double>> shares(parts, std::vector<double>(parts, 0.0));
    for (std::size_t b = 0; b < blocks.size(); ++b)
        shares[b / parts][b % parts] = total > 0.0 ? blocks[b] / total : 0.0;
    return shares;
}

std::vector<std::int64_t> count_pairs(const Comm& comm, const SparseCoefficients& coefficients) {
    const auto features = at(coefficients.features);
    std::vector<std::int64_t> counts(features + 1, 0);
    for (std::size_t k = 0; k < coefficients.rows.size(); ++k) {
        std::size_t nonzero = 0;
        for (std::size_t h = 0; h < features; ++h)
            nonzero += coefficients.values[k * features + h] != 0.0 ? 1 : 0;
        ++counts[nonzero];
    }
    for (std::int64_t& count : counts) count = all_sum(comm, count);
    return counts;
}

void scale_to_shares(std::vector<double>& values) {
    const double sum = std::accumulate(values.begin(), values.end(), 0.0);
    if (sum <= 0.0) return;
    for (double& value : values) value /= sum;
}

}  // namespace

FeatureStrength feature_strength(const Comm& comm, const SparseCoefficients& coefficients,
                                 const std::vector<int>& part_of_patch, int parts) {
    const auto features = at(coefficients.features);
    const std::vector<double> sums =
        all_gather(comm, std::span<const double>(column_sums(coefficients, part_of_patch)));
    FeatureStrength strength;
    strength.overall.assign(features, 0.0);
    strength.of_part.assign(at(parts), std::vector<double>(features, 0.0));
    strength.inside.assign(at(parts), 0.0);
    std::vector<double> whole(at(parts), 0.0);
    for (std::size_t j = 0; j < part_of_patch.size(); ++j) {
        const auto part = at(part_of_patch[j]);
        const double* const all = sums.data() + j * 2 * features;
        for (std::size_t h = 0; h < features; ++h) {
            strength.overall[h] += all[h];
            strength.of_part[part][h] += all[features + h];
            whole[part] += all[h];
            strength.inside[part] += all[features + h];
        }
    }
    for (std::size_t part = 0; part < whole.size(); ++part) {
        strength.inside[part] = whole[part] > 0.0 ? strength.inside[part] / whole[part] : 0.0;
        scale_to_shares(strength.of_part[part]);
    }
    scale_to_shares(strength.overall);
    strength.blocks = block_structure(comm, coefficients, part_of_patch, at(parts));
    strength.pairs_by_features = count_pairs(comm, coefficients);
    return strength;
}

}  // namespace coseg
