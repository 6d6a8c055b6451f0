#include "solvers/partition/patch_partition.hpp"

#include <algorithm>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "solvers/affinity/affinity.hpp"
#include "solvers/affinity/graph_components.hpp"
#include "solvers/spectral/normalized_cut.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/parallel/record_exchange.hpp"

namespace coseg {

namespace {

/// The terms of every start's graph, rows as the group that works on a graph owns them.
struct CutTerms {
    SparseRows base;
    PositionFrame frame;
    double placed_share = 1.0;  ///< total of the base weighed by place over its own
    SparseRows adjacency;
    SparseRows overlap;
    double adjacency_scale = 0.0;
    double overlap_scale = 0.0;
    std::vector<GlobalPatchNeighbors> neighbors;
    std::vector<GlobalPatchOverlap> overlaps;
    SparseRows within_mesh_affinity;  ///< A' + O', complete: what a patch set aside follows
};

/// What came of the start of this number.
struct LabelledOutcome {
    int index = 0;
    StartOutcome outcome;
    std::vector<int> labels;
    std::vector<double> eigenvalues;  ///< as in CutResult
    static constexpr auto fields() {
        return std::tuple(
            field("index", &LabelledOutcome::index), field("outcome", &LabelledOutcome::outcome),
            field("labels", &LabelledOutcome::labels), field("eigenvalues", &LabelledOutcome::eigenvalues));
    }
};

bool asks_for_positions(const CutOptions& options) {
    return std::any_of(options.starts.begin(), options.starts.end(),
                       [](const CutStart& start) { return start.graph.placed; });
}

void refuse_bad_request(const Comm& comm, const CutInput& input, const CutOptions& options) {
    agree(comm, [&] {
        const auto patches = static_cast<std::int64_t>(input.mesh_of.size());
        if (options.parts < 1 || options.parts > patches) {
            throw Error(ExitCode::usage, std::to_string(options.parts) +
                                             " parts are asked for, but there are " +
                                             std::to_string(patches) + " patches; ask for 1 to " +
                                             std::to_string(patches) + " parts or for more patches");
        }
        if (input.coefficients.size != patches ||
            static_cast<std::int64_t>(input.patch_area.size()) != patches) {
            throw Error(ExitCode::internal,
                        "coefficients, meshes and areas of the cut are of different lengths");
        }
        if (options.starts.empty()) throw Error(ExitCode::internal, "the cut was given no start");
        if (asks_for_positions(options) && (input.positions == nullptr || input.positions->cols() != patches))
            throw Error(ExitCode::internal, "a start of the cut uses positions, but not every patch has one");
    });
}

SparseRows base_affinity(const Comm& comm, const CutInput& input, const CutOptions& options,
                         const std::vector<GlobalPatchNeighbors>& neighbors) {
    SparseRows base = options.form == AffinityForm::formula_8 ? symmetric_affinity(comm, input.coefficients)
                                                              : normalized_links(comm, input.coefficients);
    if (options.minima_rule) apply_minima_rule(base, neighbors);
    return base;
}

void find_places(const Comm& comm, const CutInput& input, double base_total, CutTerms& terms) {
    terms.frame = position_frame(comm, terms.base, *input.positions, input.mesh_of);
    SparseRows placed = terms.base;
    weigh_by_position(terms.frame, *input.positions, input.mesh_of, placed);
    if (base_total > 0.0) terms.placed_share = total(comm, placed) / base_total;
}

/// `one_rank`: the group that works on a graph is one rank, so every rank holds complete terms.
CutTerms cut_terms(const Comm& comm, const Comm& self, bool one_rank, const CutInput& input,
                   const CutOptions& options) {
    const auto size = static_cast<std::int64_t>(input.mesh_of.size());
    const BlockRange all{0, size};
    CutTerms terms;
    terms.neighbors = gather_patch_pairs(comm, input.neighbors_local, static_cast<int>(size));
    terms.overlaps = gather_patch_pairs(comm, input.overlaps_local, static_cast<int>(size));
    const SparseRows adjacency = adjacency_affinity(all, terms.neighbors, input.mesh_of);
    const SparseRows overlap = overlap_affinity(all, terms.overlaps, size);
    terms.base = base_affinity(comm, input, options, terms.neighbors);
    const double base_total = total(comm, terms.base);
    const double reference = base_total > 0.0 ? base_total : static_cast<double>(size);
    const double adjacency_total = total(self, adjacency);
    const double overlap_total = total(self, overlap);
    terms.adjacency_scale = adjacency_total > 0.0 ? reference / adjacency_total : 0.0;
    terms.overlap_scale = overlap_total > 0.0 ? reference / overlap_total : 0.0;
    const WeightedMatrix within_mesh_affinity[] = {{&adjacency, terms.adjacency_scale},
                                                   {&overlap, terms.overlap_scale}};
    terms.within_mesh_affinity = weighted_sum(within_mesh_affinity);
    if (asks_for_positions(options)) find_places(comm, input, base_total, terms);
    if (one_rank) {
        terms.base = gather_rows(comm, terms.base);
        terms.adjacency = adjacency;
        terms.overlap = overlap;
    } else {
        terms.adjacency = adjacency_affinity(terms.base.rows, terms.neighbors, input.mesh_of);
        terms.overlap = overlap_affinity(terms.base.rows, terms.overlaps, size);
    }
    return terms;
}

SparseRows graph_of(const CutTerms& terms, const CutInput& input, GraphWeights weights, double drop_below) {
    const double share = weights.placed ? terms.placed_share : 1.0;
    const WeightedMatrix parts[] = {{&terms.base, 1.0},
                                    {&terms.adjacency, share * weights.adjacency * terms.adjacency_scale},
                                    {&terms.overlap, share * weights.overlap * terms.overlap_scale}};
    SparseRows graph = weighted_sum(parts);
    // Between meshes the graph is the base.
    if (weights.placed) weigh_by_position(terms.frame, *input.positions, input.mesh_of, graph);
    if (drop_below > 0.0) drop_small_entries(graph, drop_below);
    return graph;
}

std::vector<int> cluster_sizes(const std::vector<int>& labels, int clusters) {
    std::vector<int> sizes(at(clusters), 0);
    for (const int label : labels) {
        if (label >= 0) ++sizes[at(label)];
    }
    return sizes;
}

/// Everything that the starts of one graph share.
struct GraphCut {
    const Comm& group;
    const CutInput& input;
    const CutOptions& options;
    const CutTerms& terms;
    const SparseRows& graph;
    const SpectralEmbedding& embedding;
};

/// What starts with the same graph and number of clusters share.
struct Clustering {
    int count = 0;
    std::vector<int> labels;  ///< of every patch, those set aside included
    std::vector<int> sizes;
    ClusterLinks links;
    int set_aside = 0;
    int unreached = 0;
};

Clustering clustering_of(const GraphCut& cut, int count) {
    Clustering result;
    result.count = count;
    result.labels = cut_embedding(cut.embedding, count, cut.graph.size);
    const std::vector<int> sizes = cluster_sizes(result.labels, count);
    const auto largest = static_cast<int>(std::max_element(sizes.begin(), sizes.end()) - sizes.begin());
    result.set_aside = static_cast<int>(std::count(result.labels.begin(), result.labels.end(), -1));
    result.unreached = attach_set_aside(result.labels, cut.terms.within_mesh_affinity, largest);
    result.sizes = cluster_sizes(result.labels, count);
    result.links = cluster_links(cut.group, cut.graph, result.labels, count);
    return result;
}

int cluster_count(const GraphCut& cut, int index) {
    const int asked = cut.options.starts[at(index)].clusters;
    return std::min(asked, static_cast<int>(cut.embedding.eigenvalues.size()));
}

/// The outcome of a start but for its terms.
LabelledOutcome run_start(const GraphCut& cut, int index, const Clustering& clusters) {
    const CutStart& start = cut.options.starts[at(index)];
    LabelledOutcome result;
    result.index = index;
    result.outcome.start = start;
    result.outcome.set_aside = clusters.set_aside;
    result.outcome.unreached = clusters.unreached;
    result.eigenvalues.assign(cut.embedding.eigenvalues.begin(),
                              cut.embedding.eigenvalues.begin() + clusters.count);
    const std::vector<int> part_of_cluster =
        merge_clusters(clusters.links, clusters.sizes, cut.options.parts, start.merging);
    for (const int cluster : clusters.labels) result.labels.push_back(part_of_cluster[at(cluster)]);
    result.outcome.parts_found = 1 + *std::max_element(result.labels.begin(), result.labels.end());
    // Numbered alike, partitions that are the same have the same terms to the last bit.
    result.labels =
        canonical_labels(result.labels, cut.options.parts, cut.input.patch_area, cut.input.mesh_of);
    return result;
}

/// Starts of one graph often end in the same partition, whose terms are then found once.
void add_terms(const GraphCut& cut, const std::vector<LabelledOutcome>& earlier, LabelledOutcome& result) {
    const auto same = std::find_if(earlier.begin(), earlier.end(), [&](const LabelledOutcome& other) {
        return other.labels == result.labels;
    });
    if (same != earlier.end()) {
        result.outcome.terms = same->outcome.terms;
        return;
    }
    const PartitionEvidence evidence{cut.terms.neighbors, cut.terms.overlaps, cut.input.descriptors,
                                     cut.terms.base,      cut.input.mesh_of,  cut.input.patch_area};
    result.outcome.terms = partition_terms(cut.group, evidence, result.labels, cut.options.parts);
}

/// The starts that share a graph, in the order of their first.
std::vector<std::vector<int>> starts_by_graph(const std::vector<CutStart>& starts) {
    std::vector<std::vector<int>> groups;
    for (std::size_t k = 0; k < starts.size(); ++k) {
        const auto same = std::find_if(groups.begin(), groups.end(), [&](const std::vector<int>& group) {
            return starts[at(group.front())].graph == starts[k].graph;
        });
        if (same == groups.end()) {
            groups.push_back({static_cast<int>(k)});
        } else {
            same->push_back(static_cast<int>(k));
        }
    }
    return groups;
}

std::vector<LabelledOutcome> run_graph(const Comm& group, const CutInput& input, const CutOptions& options,
                                       const CutTerms& terms, const std::vector<int>& starts) {
    const CutStart& first = options.starts[at(starts.front())];
    const SparseRows graph = graph_of(terms, input, first.graph, options.drop_below);
    int count = options.parts;
    for (const int k : starts) count = std::max(count, options.starts[at(k)].clusters);
    const SpectralEmbedding embedding =
        spectral_embedding(group, graph, options.parts, count, options.spectral, input.mesh_of);
    const GraphCut cut{group, input, options, terms, graph, embedding};
    std::vector<LabelledOutcome> outcomes;
    Clustering clusters;
    for (const int k : starts) {
        const int wanted = cluster_count(cut, k);
        if (clusters.count != wanted) clusters = clustering_of(cut, wanted);
        LabelledOutcome result = run_start(cut, k, clusters);
        add_terms(cut, outcomes, result);
        outcomes.push_back(std::move(result));
    }
    return outcomes;
}

/// Puts outcomes into the order of the starts.
std::vector<LabelledOutcome> in_order(std::vector<LabelledOutcome> outcomes) {
    std::sort(outcomes.begin(), outcomes.end(),
              [](const LabelledOutcome& a, const LabelledOutcome& b) { return a.index < b.index; });
    return outcomes;
}

/// Graphs dealt over the ranks, each cut by one of them. Collective.
std::vector<LabelledOutcome> run_dealt(const Comm& comm, const Comm& self, const CutInput& input,
                                       const CutOptions& options, const CutTerms& terms) {
    const std::vector<std::vector<int>> graphs = starts_by_graph(options.starts);
    std::vector<LabelledOutcome> mine;
    agree(comm, [&] {
        for (auto q = at(comm.rank()); q < graphs.size(); q += at(comm.size())) {
            for (LabelledOutcome& r : run_graph(self, input, options, terms, graphs[q])) {
                mine.push_back(std::move(r));
            }
        }
    });
    return in_order(all_gather_records(comm, mine));
}

/// One graph after the other, each cut by all ranks. Collective.
std::vector<LabelledOutcome> run_together(const Comm& comm, const CutInput& input, const CutOptions& options,
                                          const CutTerms& terms) {
    std::vector<LabelledOutcome> all;
    for (const std::vector<int>& starts : starts_by_graph(options.starts)) {
        for (LabelledOutcome& r : run_graph(comm, input, options, terms, starts)) all.push_back(std::move(r));
    }
    return in_order(std::move(all));
}

/// The start to take; gives every outcome its score. Starts with fewer parts than others found are not
/// eligible.
std::size_t choose(std::vector<LabelledOutcome>& outcomes, const CutInput& input,
                   const ChoiceWeights& weights) {
    std::vector<PartitionTerms> terms;
    int most = 0;
    for (const LabelledOutcome& r : outcomes) {
        terms.push_back(r.outcome.terms);
        most = std::max(most, r.outcome.parts_found);
    }
    std::vector<BetweenPartVariance> descriptor_weights;
    for (const ChoiceDescriptor& d : input.descriptors) descriptor_weights.push_back(d.weight);
    const std::vector<double> scores = partition_scores(terms, weights, descriptor_weights);
    std::vector<bool> eligible;
    for (std::size_t k = 0; k < outcomes.size(); ++k) {
        outcomes[k].outcome.score = scores[k];
        eligible.push_back(outcomes[k].outcome.parts_found == most);
    }
    return best_partition(terms, scores, eligible, weights);
}

std::vector<int> count_meshes(const std::vector<int>& part_of_patch, const std::vector<int>& mesh_of,
                              int parts) {
    std::vector<std::vector<int>> meshes(at(parts));
    for (std::size_t i = 0; i < mesh_of.size(); ++i) {
        meshes[at(part_of_patch[i])].push_back(mesh_of[i]);
    }
    std::vector<int> counts;
    for (std::vector<int>& of_part : meshes) {
        std::sort(of_part.begin(), of_part.end());
        counts.push_back(static_cast<int>(std::unique(of_part.begin(), of_part.end()) - of_part.begin()));
    }
    return counts;
}

void describe_parts(const std::vector<int>& mesh_of, const std::vector<double>& patch_area, int parts,
                    CutResult& result) {
    result.part_share = mean_area_shares(result.part_of_patch, parts, patch_area, mesh_of);
    result.meshes_with_part = count_meshes(result.part_of_patch, mesh_of, parts);
}

/// K, K+1, K+2, 2K, 2.5K rounded down, 3K without repetition.
std::vector<int> cluster_counts(int parts) {
    std::vector<int> clusters = {parts, parts + 1, parts + 2, 2 * parts, 5 * parts / 2, 3 * parts};
    std::sort(clusters.begin(), clusters.end());
    clusters.erase(std::unique(clusters.begin(), clusters.end()), clusters.end());
    return clusters;
}

}  // namespace

std::vector<CutStart> pooled_starts(int parts, bool placed) {
    const std::vector<int> clusters = cluster_counts(parts);
    std::vector<CutStart> starts;
    for (const double weight : {1.0, 2.0, 4.0, 8.0}) {
        const GraphWeights graph{weight, weight, placed};
        for (const int count : clusters) {
            starts.push_back({graph, count, MergeRule::normalized_cut});
            if (count > parts) starts.push_back({graph, count, MergeRule::linkage});
        }
    }
    return starts;
}

std::vector<CutStart> articulated_starts(int parts) {
    constexpr GraphWeights without_adjacency{0.0, 1.0};
    std::vector<CutStart> starts;
    for (const int count : cluster_counts(parts)) {
        if (count == parts) continue;
        starts.push_back({without_adjacency, count, MergeRule::normalized_cut});
    }
    return starts;
}

std::vector<CutStart> single_start(int parts, double adjacency) {
    const GraphWeights graph{adjacency, adjacency};
    return {{graph, parts, MergeRule::normalized_cut}};
}

CutResult described_partition(const std::vector<int>& labels, int parts, const std::vector<int>& mesh_of,
                              const std::vector<double>& patch_area) {
    CutResult result;
    result.part_of_patch = canonical_labels(labels, parts, patch_area, mesh_of);
    describe_parts(mesh_of, patch_area, parts, result);
    return result;
}

CutResult partition_patches(const Comm& comm, const CutInput& input, const CutOptions& options) {
    refuse_bad_request(comm, input, options);
    CutResult result;
    if (options.parts == 1) {
        result.part_of_patch.assign(input.mesh_of.size(), 0);
        describe_parts(input.mesh_of, input.patch_area, 1, result);
        return result;
    }
    const Comm self(MPI_COMM_SELF);
    // At most: an entry and its transpose may fall together, never apart.
    const std::int64_t entries = 2 * all_sum(comm, static_cast<std::int64_t>(input.coefficients.rows.size()));
    const bool one_rank = entries <= options.one_rank_entries;
    const CutTerms terms = cut_terms(comm, self, one_rank, input, options);
    std::vector<LabelledOutcome> outcomes =
        one_rank ? run_dealt(comm, self, input, options, terms) : run_together(comm, input, options, terms);
    result.chosen = static_cast<int>(choose(outcomes, input, options.choice));
    result.part_of_patch = std::move(outcomes[at(result.chosen)].labels);
    result.eigenvalues = std::move(outcomes[at(result.chosen)].eigenvalues);
    for (LabelledOutcome& r : outcomes) result.starts.push_back(std::move(r.outcome));
    result.frame = terms.frame;
    describe_parts(input.mesh_of, input.patch_area, options.parts, result);
    return result;
}

}  // namespace coseg
