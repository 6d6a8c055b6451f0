#include "solvers/affinity/affinity.hpp"

#include <algorithm>
#include <utility>

#include "src/base/index.hpp"

namespace coseg {

namespace {

/// value_ij at (i, j) and at (j, i).
SparseRows plus_transpose(const Comm& comm, const SparseCoefficients& coefficients,
                          const std::vector<double>& values) {
    std::vector<SparseEntry> entries;
    entries.reserve(2 * values.size());
    for (std::int64_t c = 0; c < coefficients.columns.size(); ++c) {
        const auto column = static_cast<int>(coefficients.columns.begin + c);
        const auto end = at(coefficients.offsets[at(c) + 1]);
        for (auto k = at(coefficients.offsets[at(c)]); k < end; ++k) {
            entries.push_back({coefficients.rows[k], column, values[k]});
            entries.push_back({column, coefficients.rows[k], values[k]});
        }
    }
    return exchange_entries(comm, coefficients.size, std::move(entries));
}

/// The weight of `pair` in each mesh's own scale.
double adjacency_weight(const GlobalPatchNeighbors& pair) {
    const double flat = 1.0 - std::clamp(pair.concavity, 0.0, 1.0);
    const double square = flat * flat;
    return pair.boundary_length * square * square * flat;
}

void add_both_ways(BlockRange range, int a, int b, double value, std::vector<SparseEntry>& entries) {
    if (value <= 0.0) return;
    if (range.contains(a)) entries.push_back({a, b, value});
    if (range.contains(b)) entries.push_back({b, a, value});
}

}  // namespace

SparseRows symmetric_affinity(const Comm& comm, const SparseCoefficients& coefficients) {
    std::vector<double> halves = pair_norms(coefficients);
    for (double& value : halves) value *= 0.5;
    return plus_transpose(comm, coefficients, halves);
}

SparseRows normalized_links(const Comm& comm, const SparseCoefficients& coefficients) {
    std::vector<double> shares = pair_norms(coefficients);
    for (std::size_t c = 0; c + 1 < coefficients.offsets.size(); ++c) {
        const auto begin = at(coefficients.offsets[c]);
        const auto end = at(coefficients.offsets[c + 1]);
        double sum = 0.0;
        for (std::size_t k = begin; k < end; ++k) sum += shares[k];
        for (std::size_t k = begin; k < end && sum > 0.0; ++k) shares[k] /= sum;
    }
    return plus_transpose(comm, coefficients, shares);
}

void apply_minima_rule(SparseRows& affinity, const std::vector<GlobalPatchNeighbors>& neighbors) {
    const auto weaken = [&](int row, int column, double factor) {
        if (!affinity.rows.contains(row)) return;
        const auto r = at(row - affinity.rows.begin);
        const auto begin = affinity.columns.begin() + affinity.offsets[r];
        const auto end = affinity.columns.begin() + affinity.offsets[r + 1];
        const auto place = std::lower_bound(begin, end, column);
        if (place == end || *place != column) return;
        affinity.values[at(place - affinity.columns.begin())] *= factor;
    };
    for (const GlobalPatchNeighbors& pair : neighbors) {
        const double factor = 1.0 - std::clamp(pair.concavity, 0.0, 1.0);
        weaken(pair.patch_a, pair.patch_b, factor);
        weaken(pair.patch_b, pair.patch_a, factor);
    }
}

SparseRows adjacency_affinity(BlockRange range, const std::vector<GlobalPatchNeighbors>& neighbors,
                              const std::vector<int>& mesh_of) {
    const int meshes = mesh_count(mesh_of);
    std::vector<double> mesh_total(at(meshes), 0.0);
    const auto mesh = [&](const GlobalPatchNeighbors& pair) { return at(mesh_of[at(pair.patch_a)]); };
    for (const GlobalPatchNeighbors& pair : neighbors) mesh_total[mesh(pair)] += 2.0 * adjacency_weight(pair);
    std::vector<SparseEntry> entries;
    for (const GlobalPatchNeighbors& pair : neighbors) {
        if (mesh_total[mesh(pair)] <= 0.0) continue;
        const double value = adjacency_weight(pair) / mesh_total[mesh(pair)];
        add_both_ways(range, pair.patch_a, pair.patch_b, value, entries);
    }
    return rows_from_entries(static_cast<std::int64_t>(mesh_of.size()), range, std::move(entries));
}

SparseRows overlap_affinity(BlockRange range, const std::vector<GlobalPatchOverlap>& overlaps,
                            std::int64_t size) {
    std::vector<SparseEntry> entries;
    for (const GlobalPatchOverlap& pair : overlaps) {
        add_both_ways(range, pair.patch_a, pair.patch_b, pair.intersection_over_union, entries);
    }
    return rows_from_entries(size, range, std::move(entries));
}

}  // namespace coseg
