#include "tests/support/graphs.hpp"

#include <algorithm>
#include <map>

#include "src/base/seeded_random.hpp"

namespace coseg::testing_graphs {

namespace {

std::uint64_t word(int i) { return static_cast<std::uint64_t>(i); }

struct ToyShape {
    int parts;
    int patches_per_part;
    [[nodiscard]] int patches() const { return 2 * parts * patches_per_part; }
    [[nodiscard]] int place(int local) const { return local % (parts * patches_per_part); }
    [[nodiscard]] int part(int local) const { return place(local) / patches_per_part; }
};

void append_relations(const ToyShape& shape, int first, ToyCollection& toy) {
    const int chain = shape.parts * shape.patches_per_part;
    for (int layer = 0; layer < 2; ++layer) {
        for (int i = 0; i + 1 < chain; ++i) {
            const bool joint = shape.part(i) != shape.part(i + 1);
            const int a = first + layer * chain + i;
            toy.neighbors.push_back({a, a + 1, 0.1, joint ? 0.9 : 0.1});
        }
    }
    for (int i = 0; i < chain; ++i) toy.overlaps.push_back({first + i, first + chain + i, 0.9});
}

/// Pairs (row, weight) of column j: one patch of the same segment in each other mesh, and now and then a
/// wrong one.
std::map<int, double> toy_column(const ToyShape& shape, int meshes, int j, std::uint64_t seed) {
    std::map<int, double> column;
    const int mesh = j / shape.patches();
    const int part = shape.part(j % shape.patches());
    for (int m = 0; m < meshes; ++m) {
        if (m == mesh) continue;
        const std::uint64_t hash = hash_words({seed, word(j), word(m)});
        const bool wrong = hash % 8 == 0;
        const int segment = wrong ? static_cast<int>((hash >> 8U) % word(shape.parts)) : part;
        const int inside = static_cast<int>((hash >> 16U) % word(shape.patches_per_part));
        const int layer = static_cast<int>((hash >> 32U) % 2);
        const int local =
            layer * shape.parts * shape.patches_per_part + segment * shape.patches_per_part + inside;
        column[m * shape.patches() + local] = (wrong ? 0.3 : 1.0) * (0.5 + uniform_of(hash));
    }
    return column;
}

}  // namespace

SparseRows graph(int nodes, const std::vector<Edge>& edges) {
    std::vector<SparseEntry> entries;
    for (const Edge& e : edges) {
        entries.push_back({e.a, e.b, e.weight});
        entries.push_back({e.b, e.a, e.weight});
    }
    return rows_from_entries(nodes, {0, nodes}, std::move(entries));
}

SparseRows owned_rows(const Comm& comm, const SparseRows& complete) {
    const BlockRange range = block_range(complete.size, comm.size(), comm.rank(), row_tile);
    std::vector<SparseEntry> entries;
    for (auto i = range.begin; i < range.end; ++i) {
        for (auto k = complete.offsets[static_cast<std::size_t>(i)];
             k < complete.offsets[static_cast<std::size_t>(i) + 1]; ++k) {
            const auto e = static_cast<std::size_t>(k);
            entries.push_back({static_cast<int>(i), complete.columns[e], complete.values[e]});
        }
    }
    return rows_from_entries(complete.size, range, std::move(entries));
}

std::vector<Edge> path_edges(int nodes) {
    std::vector<Edge> edges;
    for (int i = 0; i + 1 < nodes; ++i) edges.push_back({i, i + 1});
    return edges;
}

std::vector<Edge> cycle_edges(int nodes) {
    std::vector<Edge> edges = path_edges(nodes);
    edges.push_back({nodes - 1, 0});
    return edges;
}

std::vector<Edge> clique_edges(int first, int nodes, double weight) {
    std::vector<Edge> edges;
    for (int i = 0; i < nodes; ++i) {
        for (int j = i + 1; j < nodes; ++j) edges.push_back({first + i, first + j, weight});
    }
    return edges;
}

std::vector<Edge> block_edges(int blocks, int nodes, double weak, std::uint64_t seed) {
    std::vector<Edge> edges;
    for (int i = 0; i < blocks * nodes; ++i) {
        for (int j = i + 1; j < blocks * nodes; ++j) {
            const std::uint64_t hash = hash_words({seed, word(i), word(j)});
            const double weight = 0.5 + uniform_of(hash);
            if (i % blocks == j % blocks) {
                edges.push_back({i, j, weight});
            } else if (weak > 0.0 && hash % 16 == 0) {
                edges.push_back({i, j, weak * weight});
            }
        }
    }
    return edges;
}

bool same_partition(const std::vector<int>& a, const std::vector<int>& b) {
    if (a.size() != b.size()) return false;
    std::map<int, int> forth;
    std::map<int, int> back;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (forth.emplace(a[i], b[i]).first->second != b[i]) return false;
        if (back.emplace(b[i], a[i]).first->second != a[i]) return false;
    }
    return true;
}

SparseCoefficients random_coefficients(const Comm& comm, int size, int features, int per_column,
                                       std::uint64_t seed) {
    SparseCoefficients w;
    w.size = size;
    w.columns = block_range(size, comm.size(), comm.rank(), coefficient_tile);
    w.features = features;
    w.offsets.assign(1, 0);
    for (auto j = static_cast<int>(w.columns.begin); j < static_cast<int>(w.columns.end); ++j) {
        for (int i = 0; i < size && j % 7 != 3; ++i) {
            const std::uint64_t hash = hash_words({seed, word(i), word(j)});
            if (i == j || hash % word(size) >= word(per_column)) continue;
            w.rows.push_back(i);
            for (int h = 0; h < features; ++h) {
                const double u = uniform_of(hash_words({hash, word(h)}));
                w.values.push_back(h > 0 && u < 1.0 / 3.0 ? 0.0 : u);
            }
        }
        w.offsets.push_back(static_cast<std::int64_t>(w.rows.size()));
    }
    return w;
}

ToyCollection toy_collection(const Comm& comm, int meshes, int parts, int patches_per_part,
                             std::uint64_t seed) {
    const ToyShape shape{parts, patches_per_part};
    ToyCollection toy;
    toy.patches = meshes * shape.patches();
    for (int m = 0; m < meshes; ++m) {
        for (int local = 0; local < shape.patches(); ++local) {
            toy.mesh_of.push_back(m);
            toy.truth.push_back(shape.part(local));
            toy.area.push_back((1.0 + 0.5 * shape.part(local)) / shape.patches());
        }
        if (m % comm.size() == comm.rank()) append_relations(shape, m * shape.patches(), toy);
    }
    SparseCoefficients& w = toy.coefficients;
    w.size = toy.patches;
    w.columns = block_range(toy.patches, comm.size(), comm.rank(), coefficient_tile);
    w.features = 1;
    w.offsets.assign(1, 0);
    for (auto j = w.columns.begin; j < w.columns.end; ++j) {
        for (const auto& [row, value] : toy_column(shape, meshes, static_cast<int>(j), seed)) {
            w.rows.push_back(row);
            w.values.push_back(value);
        }
        w.offsets.push_back(static_cast<std::int64_t>(w.rows.size()));
    }
    toy.histograms.resize(parts, toy.patches);
    for (int i = 0; i < toy.patches; ++i) {
        for (int p = 0; p < parts; ++p) {
            const auto noise = static_cast<float>(0.3 * uniform_of(hash_words({word(i), word(p)})));
            toy.histograms(p, i) = toy.truth[static_cast<std::size_t>(i)] == p ? 1.0F + noise : noise;
        }
    }
    return toy;
}

SinglePrecisionFeatures segment_features(const ToyCollection& toy) {
    return {Comm(MPI_COMM_SELF), FeatureMatrices({toy.histograms.cast<double>()})};
}

std::vector<ChoiceDescriptor> segment_descriptors(const ToyCollection& toy, BetweenPartVariance weight) {
    return {{patch_columns(toy.histograms), weight}};
}

CutInput toy_input(const ToyCollection& toy, std::span<const ChoiceDescriptor> descriptors,
                   const SinglePrecisionFeatures* features) {
    return {.coefficients = toy.coefficients,
            .neighbors_local = toy.neighbors,
            .overlaps_local = toy.overlaps,
            .mesh_of = toy.mesh_of,
            .patch_area = toy.area,
            .descriptors = descriptors,
            .features = features};
}

}  // namespace coseg::testing_graphs
