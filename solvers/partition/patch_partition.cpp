#include "solvers/partition/patch_partition.hpp"

#include <algorithm>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "solvers/affinity/affinity.hpp"
#include "solvers/affinity/graph_components.hpp"
#include "solvers/partition/cluster_merging.hpp"
#include "solvers/partition/cut_graphs.hpp"
#include "solvers/partition/part_shares.hpp"
#include "solvers/partition/partition_objective.hpp"
#include "solvers/partition/patch_moves.hpp"
#include "solvers/spectral/normalized_cut.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/parallel/record_exchange.hpp"

namespace coseg {

namespace {

/// What came of the start of this number.
struct LabelledOutcome {
    int index = 0;
    StartOutcome outcome;
    std::vector<int> labels;          ///< of patches: clusters, then parts
    std::vector<double> eigenvalues;  ///< as in CutResult
    static constexpr auto fields() {
        return std::tuple(
            field("index", &LabelledOutcome::index), field("outcome", &LabelledOutcome::outcome),
            field("labels", &LabelledOutcome::labels), field("eigenvalues", &LabelledOutcome::eigenvalues));
    }
};

/// Partitions that are improved by moves of single patches: those with the best scores.
constexpr std::size_t finalists = 12;

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

std::vector<int> cluster_sizes(const std::vector<int>& labels, int clusters) {
    std::vector<int> sizes(at(clusters), 0);
    for (const int label : labels) {
        if (label >= 0) ++sizes[at(label)];
    }
    return sizes;
}

/// Everything that the clusterings of one graph share.
struct GraphCut {
    const SparseRows& within_mesh_affinity;
    const SpectralEmbedding& embedding;
    std::int64_t patches = 0;
};

/// The clusters of a start, numbered 0, 1, ... without gaps.
LabelledOutcome clustering(const GraphCut& cut, int index, const CutStart& start) {
    const int count = std::min(start.clusters, static_cast<int>(cut.embedding.eigenvalues.size()));
    LabelledOutcome result;
    result.index = index;
    result.outcome.start = start;
    result.labels = cut_embedding(cut.embedding, count, cut.patches);
    const std::vector<int> sizes = cluster_sizes(result.labels, count);
    const auto largest = static_cast<int>(std::max_element(sizes.begin(), sizes.end()) - sizes.begin());
    result.outcome.set_aside = static_cast<int>(std::count(result.labels.begin(), result.labels.end(), -1));
    result.outcome.unreached = attach_set_aside(result.labels, cut.within_mesh_affinity, largest);
    result.eigenvalues.assign(cut.embedding.eigenvalues.begin(), cut.embedding.eigenvalues.begin() + count);
    result.labels = renumbered(result.labels);
    return result;
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

/// What all steps of one call look at.
struct Task {
    const CutInput& input;
    const CutOptions& options;
    const GraphInput& graphs;
    const GraphTerms& terms;
    const PartitionEvidence& evidence;
};

/// The clusterings of the starts of one graph. Collective over the group.
std::vector<LabelledOutcome> clusterings_of_graph(const Comm& group, const Task& task,
                                                  const std::vector<int>& starts) {
    const std::vector<CutStart>& all = task.options.starts;
    const SparseRows graph =
        graph_of(task.terms, task.graphs, all[at(starts.front())].graph, task.options.drop_below);
    int count = task.options.parts;
    for (const int k : starts) count = std::max(count, all[at(k)].clusters);
    const SpectralEmbedding embedding = spectral_embedding(group, graph, task.options.parts, count,
                                                           task.options.spectral, task.input.mesh_of);
    const GraphCut cut{task.terms.within_mesh_affinity, embedding, graph.size};
    std::vector<LabelledOutcome> clusterings;
    for (const int k : starts) clusterings.push_back(clustering(cut, k, all[at(k)]));
    return clusterings;
}

/// The clusterings that this rank goes on with. Graphs are dealt over the ranks, each cut by one of them.
/// Collective.
std::vector<LabelledOutcome> dealt_clusterings(const Comm& comm, const Task& task) {
    const Comm self(MPI_COMM_SELF);
    const std::vector<std::vector<int>> graphs = starts_by_graph(task.options.starts);
    std::vector<LabelledOutcome> mine;
    agree(comm, [&] {
        for (auto q = at(comm.rank()); q < graphs.size(); q += at(comm.size())) {
            for (LabelledOutcome& r : clusterings_of_graph(self, task, graphs[q])) {
                mine.push_back(std::move(r));
            }
        }
    });
    return mine;
}

/// The same where one graph after the other is cut by all ranks.
std::vector<LabelledOutcome> shared_clusterings(const Comm& comm, const Task& task) {
    std::vector<LabelledOutcome> mine;
    for (const std::vector<int>& starts : starts_by_graph(task.options.starts)) {
        for (LabelledOutcome& r : clusterings_of_graph(comm, task, starts)) {
            if (r.index % comm.size() == comm.rank()) mine.push_back(std::move(r));
        }
    }
    return mine;
}

/// Numbers the parts, so that partitions that are the same have the same terms to the last bit, and finds
/// terms and score.
void describe_outcome(const Task& task, LabelledOutcome& result) {
    const CutInput& input = task.input;
    const int parts = task.options.parts;
    result.labels = canonical_labels(result.labels, parts, input.patch_area, input.mesh_of);
    StartOutcome& outcome = result.outcome;
    outcome.parts_found = 1 + *std::max_element(result.labels.begin(), result.labels.end());
    outcome.degenerate = is_degenerate(area_shares(result.labels, parts, input.patch_area, input.mesh_of));
    outcome.terms = partition_terms(task.evidence, result.labels, parts);
    outcome.score = partition_score(outcome.terms, task.options.choice, input.descriptors);
}

/// Merges the clusters into parts in several ways, of which the one with the best score is taken.
LabelledOutcome merged(const Task& task, const PartitionObjective& objective,
                       const LabelledOutcome& clustering) {
    const int clusters = 1 + *std::max_element(clustering.labels.begin(), clustering.labels.end());
    if (clusters <= task.options.parts) {
        LabelledOutcome same = clustering;
        describe_outcome(task, same);
        return same;
    }
    const ClusterSums sums = cluster_sums(objective, clustering.labels, clusters);
    std::optional<LabelledOutcome> best;
    for (const std::vector<int>& part_of : merge_clusters(sums, task.options.parts)) {
        LabelledOutcome result = clustering;
        for (int& label : result.labels) label = part_of[at(label)];
        describe_outcome(task, result);
        if (!best || result.outcome.score > best->outcome.score) best = std::move(result);
    }
    return std::move(*best);
}

/// The outcome after moves of single patches, or the same one where these raise the objective but, as it
/// leaves out a term, not the score.
LabelledOutcome improved(const Task& task, const PartitionObjective& objective, LabelledOutcome outcome) {
    MovedPatches moved = move_patches(objective, outcome.labels, task.options.parts);
    LabelledOutcome after = outcome;
    after.labels = std::move(moved.labels);
    after.outcome.moved = moved.moved;
    describe_outcome(task, after);
    const bool is_better =
        after.outcome.score > outcome.outcome.score && after.outcome.degenerate <= outcome.outcome.degenerate;
    return is_better ? std::move(after) : std::move(outcome);
}

/// Outcomes with the most parts, none of them degenerate; or, if there are none, the others with the most.
std::vector<char> eligible_outcomes(const std::vector<LabelledOutcome>& outcomes) {
    int most = 0;
    for (const LabelledOutcome& r : outcomes) most = std::max(most, r.outcome.parts_found);
    std::vector<char> eligible;
    bool any = false;
    for (const LabelledOutcome& r : outcomes) {
        eligible.push_back(r.outcome.parts_found == most && !r.outcome.degenerate ? 1 : 0);
        any = any || eligible.back() != 0;
    }
    for (std::size_t k = 0; k < outcomes.size() && !any; ++k)
        eligible[k] = outcomes[k].outcome.parts_found == most ? 1 : 0;
    return eligible;
}

/// Numbers of outcomes: the eligible ones first, then by falling score, of equal ones the first.
std::vector<std::size_t> ranking(const std::vector<LabelledOutcome>& outcomes) {
    const std::vector<char> eligible = eligible_outcomes(outcomes);
    std::vector<std::size_t> order(outcomes.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        if (eligible[a] != eligible[b]) return eligible[a] > eligible[b];
        return outcomes[a].outcome.score > outcomes[b].outcome.score;
    });
    return order;
}

/// The different partitions among the best.
std::vector<std::size_t> best_outcomes(const std::vector<LabelledOutcome>& outcomes) {
    std::vector<std::size_t> best;
    for (const std::size_t k : ranking(outcomes)) {
        const bool is_new = std::none_of(best.begin(), best.end(), [&](std::size_t other) {
            return outcomes[other].labels == outcomes[k].labels;
        });
        if (is_new) best.push_back(k);
        if (best.size() == finalists) break;
    }
    return best;
}

/// All starts, merged, in their order; the best of them improved. The clusterings are those of this rank.
/// Collective.
std::vector<LabelledOutcome> searched(const Comm& comm, const Task& task,
                                      std::vector<LabelledOutcome> clusterings) {
    const PartitionObjective objective = partition_objective(task.evidence, task.options.choice);
    for (LabelledOutcome& r : clusterings) r = merged(task, objective, r);
    std::vector<LabelledOutcome> outcomes = all_gather_records(comm, clusterings);
    std::sort(outcomes.begin(), outcomes.end(),
              [](const LabelledOutcome& a, const LabelledOutcome& b) { return a.index < b.index; });
    if (outcomes.size() == 1) return outcomes;
    const std::vector<std::size_t> best = best_outcomes(outcomes);
    std::vector<LabelledOutcome> mine;
    for (auto k = at(comm.rank()); k < best.size(); k += at(comm.size()))
        mine.push_back(improved(task, objective, outcomes[best[k]]));
    for (LabelledOutcome& r : all_gather_records(comm, mine)) outcomes[at(r.index)] = std::move(r);
    return outcomes;
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

/// 2K, 5K/2, 3K, 7K/2 and 4K clusters, rounded down.
std::vector<int> cluster_counts(int parts) {
    std::vector<int> counts;
    for (int halves = 4; halves <= 8; ++halves) counts.push_back(halves * parts / 2);
    return counts;
}

}  // namespace

std::vector<CutStart> pooled_starts(int parts, bool placed) {
    std::vector<CutStart> starts;
    for (const auto& [adjacency, overlap] :
         {std::pair{0.0, 1.0}, {0.3, 1.0}, {1.0, 1.0}, {2.0, 2.0}, {4.0, 4.0}, {8.0, 8.0}}) {
        for (const int count : cluster_counts(parts)) starts.push_back({{adjacency, overlap, placed}, count});
    }
    return starts;
}

std::vector<CutStart> single_start(int parts, double adjacency) { return {{{adjacency, adjacency}, parts}}; }

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
    // At most: an entry and its transpose may fall together, never apart.
    const std::int64_t entries = 2 * all_sum(comm, static_cast<std::int64_t>(input.coefficients.rows.size()));
    const bool one_rank = entries <= options.one_rank_entries;
    const auto patches = static_cast<int>(input.mesh_of.size());
    const auto neighbors = gather_patch_pairs(comm, input.neighbors_local, patches);
    const auto overlaps = gather_patch_pairs(comm, input.overlaps_local, patches);
    const GraphInput graphs{input.coefficients, neighbors, overlaps, input.mesh_of, input.positions};
    const GraphTerms terms = graph_terms(comm, graphs,
                                         {.form = options.form,
                                          .minima_rule = options.minima_rule,
                                          .drop_below = options.drop_below,
                                          .placed = asks_for_positions(options),
                                          .complete = one_rank});
    const bool has_links = one_rank && options.choice.links > 0.0;
    const PartitionEvidence evidence{neighbors,     overlaps,         input.descriptors,
                                     input.mesh_of, input.patch_area, has_links ? &terms.base : nullptr};
    const Task task{input, options, graphs, terms, evidence};
    std::vector<LabelledOutcome> outcomes =
        searched(comm, task, one_rank ? dealt_clusterings(comm, task) : shared_clusterings(comm, task));
    result.chosen = static_cast<int>(ranking(outcomes).front());
    result.part_of_patch = std::move(outcomes[at(result.chosen)].labels);
    result.eigenvalues = std::move(outcomes[at(result.chosen)].eigenvalues);
    for (LabelledOutcome& r : outcomes) result.starts.push_back(std::move(r.outcome));
    result.frame = terms.frame;
    describe_parts(input.mesh_of, input.patch_area, options.parts, result);
    return result;
}

}  // namespace coseg
