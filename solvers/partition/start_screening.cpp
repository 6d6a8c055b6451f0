#include "solvers/partition/start_screening.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "solvers/choice/partition_objective.hpp"
#include "solvers/choice/partition_search.hpp"
#include "src/base/index.hpp"
#include "src/base/seeded_random.hpp"

namespace coseg {

namespace {

/// Some of the meshes, numbered anew in the same order, and all of their patches.
struct MeshSample {
    std::vector<int> patches;   ///< ascending
    std::vector<int> place_of;  ///< of each patch of the collection its place in `patches`, or -1
    std::vector<int> mesh_of;   ///< of each patch of the sample
};

/// `count` of `meshes`, ascending: those whose numbers have the smallest hashes.
std::vector<int> sampled(int meshes, int count) {
    std::vector<int> order(at(meshes));
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [](int a, int b) {
        return std::pair(mix_bits(static_cast<std::uint64_t>(a)), a) <
               std::pair(mix_bits(static_cast<std::uint64_t>(b)), b);
    });
    order.resize(at(count));
    std::sort(order.begin(), order.end());
    return order;
}

MeshSample mesh_sample(const std::vector<int>& mesh_of, int meshes, int count) {
    std::vector<int> number_of(at(meshes), -1);
    const std::vector<int> chosen = sampled(meshes, count);
    for (std::size_t k = 0; k < chosen.size(); ++k) number_of[at(chosen[k])] = static_cast<int>(k);
    MeshSample sample;
    sample.place_of.assign(mesh_of.size(), -1);
    for (std::size_t i = 0; i < mesh_of.size(); ++i) {
        const int mesh = number_of[at(mesh_of[i])];
        if (mesh < 0) continue;
        sample.place_of[i] = static_cast<int>(sample.patches.size());
        sample.patches.push_back(static_cast<int>(i));
        sample.mesh_of.push_back(mesh);
    }
    return sample;
}

/// The pairs inside the sample, with its numbers of patches.
template <class Pair>
std::vector<Pair> pairs_of(const MeshSample& sample, const std::vector<Pair>& pairs) {
    std::vector<Pair> inside;
    for (Pair pair : pairs) {
        pair.patch_a = sample.place_of[at(pair.patch_a)];
        pair.patch_b = sample.place_of[at(pair.patch_b)];
        if (pair.patch_a >= 0 && pair.patch_b >= 0) inside.push_back(pair);
    }
    return inside;
}

/// The rows and columns of the sample, all rows on every rank. Collective.
SparseRows rows_of(const Comm& comm, const MeshSample& sample, const SparseRowsView& all) {
    // Where every node holds all rows, each rank gives those that it would own.
    const BlockRange own = block_range(all.size, comm.size(), comm.rank(), row_tile);
    std::vector<SparseEntry> entries;
    for (std::int64_t i = std::max(own.begin, all.rows.begin); i < std::min(own.end, all.rows.end); ++i) {
        const int row = sample.place_of[at(i)];
        if (row < 0) continue;
        const auto r = at(i - all.rows.begin);
        for (auto k = at(all.offsets[r]); k < at(all.offsets[r + 1]); ++k) {
            const int column = sample.place_of[at(all.columns[k])];
            if (column >= 0) entries.push_back({row, column, all.values[k]});
        }
    }
    return gather_rows(
        comm, exchange_entries(comm, static_cast<std::int64_t>(sample.patches.size()), std::move(entries)));
}

/// What is known of the patches of the sample.
struct SampledEvidence {
    std::vector<GlobalPatchNeighbors> neighbors;
    std::vector<GlobalPatchOverlap> overlaps;
    std::vector<Eigen::MatrixXf> histograms;  ///< of each descriptor
    std::vector<double> patch_area;
    Eigen::Matrix3Xd positions;  ///< without columns where there are none
};

SampledEvidence sampled_evidence(const MeshSample& sample, const PartitionEvidence& whole,
                                 const Eigen::Matrix3Xd* positions) {
    SampledEvidence seen{pairs_of(sample, whole.neighbors), pairs_of(sample, whole.overlaps), {}, {}, {}};
    for (const ChoiceDescriptor& d : whole.descriptors)
        seen.histograms.push_back(d.histograms(Eigen::all, sample.patches));
    for (const int i : sample.patches) seen.patch_area.push_back(whole.patch_area[at(i)]);
    if (positions != nullptr) seen.positions = (*positions)(Eigen::all, sample.patches);
    return seen;
}

/// The descriptors of the whole, of the patches of the sample alone; `seen` must outlive them.
std::vector<ChoiceDescriptor> sampled_descriptors(const SampledEvidence& seen,
                                                  std::span<const ChoiceDescriptor> whole) {
    std::vector<ChoiceDescriptor> descriptors;
    for (std::size_t h = 0; h < whole.size(); ++h)
        descriptors.push_back({patch_columns(seen.histograms[h]), whole[h].weight});
    return descriptors;
}

/// The starts, in their order, whose graphs are those of the best candidates.
std::vector<CutStart> of_best_graphs(const std::vector<CutStart>& starts,
                                     const std::vector<PartitionCandidate>& candidates, std::size_t count) {
    std::vector<GraphWeights> graphs;
    const auto is_known = [&](const GraphWeights& graph) {
        return std::find(graphs.begin(), graphs.end(), graph) != graphs.end();
    };
    for (const std::size_t k : ranked_candidates(candidates)) {
        const GraphWeights& graph = candidates[k].outcome.start.graph;
        if (graphs.size() < count && !is_known(graph)) graphs.push_back(graph);
    }
    std::vector<CutStart> kept;
    for (const CutStart& start : starts) {
        if (is_known(start.graph)) kept.push_back(start);
    }
    return kept;
}

}  // namespace

std::vector<CutStart> promising_starts(const Comm& comm, const ClusteringTask& whole,
                                       const PartitionEvidence& evidence, const ChoiceWeights& weights,
                                       StartScreening screening) {
    const int meshes = mesh_count(evidence.mesh_of);
    if (whole.starts.size() == 1 || meshes < 2 * screening.meshes) return whole.starts;
    const MeshSample sample = mesh_sample(evidence.mesh_of, meshes, screening.meshes);
    const SampledEvidence seen = sampled_evidence(sample, evidence, whole.graphs.positions);
    const GraphInput graphs{seen.neighbors, seen.overlaps, sample.mesh_of,
                            whole.graphs.positions == nullptr ? nullptr : &seen.positions};
    const GraphTerms terms =
        graph_terms(Comm(MPI_COMM_SELF), rows_of(comm, sample, whole.terms.base.view()), graphs,
                    {.placed = asks_for_positions(whole.starts), .complete = true});
    const std::vector<ChoiceDescriptor> descriptors = sampled_descriptors(seen, evidence.descriptors);
    const PartitionEvidence sampled{
        seen.neighbors, seen.overlaps,   descriptors,
        sample.mesh_of, seen.patch_area, evidence.links ? std::optional(terms.base.view()) : std::nullopt};
    const PartitionObjective objective = partition_objective(sampled, weights);
    const std::vector<PartitionCandidate> candidates = search_partitions(
        comm, {sampled, objective, weights, whole.parts},
        start_clusterings(comm, {graphs, terms, whole.starts, whole.spectral, whole.drop_below, whole.parts},
                          true));
    return of_best_graphs(whole.starts, candidates, at(screening.graphs));
}

}  // namespace coseg
