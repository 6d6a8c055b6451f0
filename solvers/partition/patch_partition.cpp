#include "solvers/partition/patch_partition.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "solvers/partition/cluster_sums.hpp"
#include "solvers/partition/corrected_parts.hpp"
#include "solvers/partition/cut_graphs.hpp"
#include "solvers/partition/labelled_parts.hpp"
#include "solvers/partition/part_confidence.hpp"
#include "solvers/partition/part_levels.hpp"
#include "solvers/partition/part_regression.hpp"
#include "solvers/partition/part_scores.hpp"
#include "solvers/partition/part_shares.hpp"
#include "solvers/partition/partition_search.hpp"
#include "solvers/partition/start_clusterings.hpp"
#include "solvers/partition/start_screening.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/parallel/record_exchange.hpp"

namespace coseg {

namespace {

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
        if (input.examples != nullptr &&
            (input.features == nullptr || input.features->all().cols() != patches ||
             input.examples->area.cols() != patches || input.examples->area.rows() != options.parts))
            throw Error(ExitCode::internal, "examples and features of the cut are not of all patches");
        if (asks_for_positions(options.starts) &&
            (input.positions == nullptr || input.positions->cols() != patches))
            throw Error(ExitCode::internal, "a start of the cut uses positions, but not every patch has one");
    });
}

/// All candidates, and the number of the one that is taken.
struct Found {
    std::vector<PartitionCandidate> candidates;
    std::size_t chosen = 0;
    std::vector<double> confidence;  ///< see CutResult
};

/// Collective.
Found found_by_search(const Comm& comm, const SearchTask& task, std::vector<PartitionCandidate> clusterings) {
    Found found;
    found.candidates = search_partitions(comm, task, std::move(clusterings));
    found.chosen = ranked_candidates(found.candidates).front();
    return found;
}

/// Where there are several starts, the best partition is improved. Collective.
Found found_and_expanded(const Comm& comm, const SearchTask& task, const CutOptions& options,
                         std::vector<PartitionCandidate> clusterings) {
    Found found = found_by_search(comm, task, std::move(clusterings));
    PartitionCandidate& chosen = found.candidates[found.chosen];
    if (options.starts.size() > 1) {
        chosen = expanded(comm, task, std::move(chosen));
        found.confidence = part_confidence(task.objective, {}, chosen.labels, task.parts);
    }
    return found;
}

/// Collective.
Found found_alone(const Comm& comm, const PartitionEvidence& evidence, const CutOptions& options,
                  std::vector<PartitionCandidate> clusterings) {
    const PartitionObjective objective = partition_objective(comm, evidence, options.choice);
    return found_and_expanded(comm, {evidence, objective, options.choice, options.parts}, options,
                              std::move(clusterings));
}

/// The scores of the examples as a descriptor that a partition should explain, beside the others. The scores
/// must outlive the result.
std::vector<ChoiceDescriptor> with_scores(std::span<const ChoiceDescriptor> descriptors,
                                          const Eigen::MatrixXf& scores, double weight) {
    std::vector<ChoiceDescriptor> all(descriptors.begin(), descriptors.end());
    all.push_back({patch_columns(scores), {.pooled = weight, .per_mesh = weight}});
    return all;
}

/// The partitions that explain the scores of the examples too. Collective.
Found found_explaining(const Comm& comm, const PartitionEvidence& evidence, const Eigen::MatrixXd& scores,
                       const CutOptions& options, std::vector<PartitionCandidate> clusterings) {
    const Eigen::MatrixXf single = scores.cast<float>();
    const std::vector<ChoiceDescriptor> descriptors =
        with_scores(evidence.descriptors, single, options.examples.explained);
    PartitionEvidence sought = evidence;
    sought.descriptors = descriptors;
    const PartitionObjective objective = partition_objective(comm, sought, options.choice);
    return found_by_search(comm, {sought, objective, options.choice, options.parts}, std::move(clusterings));
}

/// The evidence of the cut, and the frame of its positions.
struct PlacedEvidence {
    const PartitionEvidence& evidence;
    const PositionFrame& frame;
};

/// From the partition without examples, the one that explains their scores, or the labels with the best
/// scores, whichever suits the examples best, to labels that follow them. Collective.
Found found_by_examples(const Comm& comm, const CutInput& input, const PlacedEvidence& placed,
                        const CutOptions& options, std::vector<PartitionCandidate> clusterings) {
    const PartitionEvidence& evidence = placed.evidence;
    std::optional<PartRegression> regression;
    SaidParts said{{}, input.examples->area, {}};
    Eigen::MatrixXd told;  // the scores by the examples alone
    agree(comm, [&] {
        regression.emplace(
            PatchLooks{*input.features, input.positions, placed.frame, input.patch_area, input.mesh_of},
            evidence.neighbors, std::vector<double>{});
        told = regression->scores(said);
    });
    std::vector<int> best_labels = labels_of_best_scores(told);
    Found explaining = found_explaining(comm, evidence, told, options, clusterings);
    const PartitionObjective objective = partition_objective(comm, evidence, options.choice);
    const SearchTask task{evidence, objective, options.choice, options.parts};
    Found alone = found_and_expanded(comm, task, options, std::move(clusterings));
    BaseChoice base(objective, *input.examples, std::move(told), options.examples.scores);
    base.offer_parts(alone.candidates[alone.chosen].labels);
    Found& found = base.offer_parts(explaining.candidates[explaining.chosen].labels) ? explaining : alone;
    base.offer(std::move(best_labels));
    said.base = base.labels();
    said.allowed = Eigen::MatrixXi::Ones(options.parts, objective.meshes);
    Eigen::MatrixXd scores;
    agree(comm, [&] { scores = regression->scores(said); });
    CorrectedPartition corrected = corrected_partition(comm, objective, said, scores, options.examples);
    PartitionCandidate& chosen = found.candidates[found.chosen];
    chosen = relabelled(task, std::move(chosen), std::move(corrected.parts));
    found.confidence = std::move(corrected.confidence);
    return std::move(found);
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

bool has_all_parts(const CutResult& result) {
    return std::none_of(result.part_share.begin(), result.part_share.end(),
                        [](double share) { return share <= 0.0; });
}

/// The labels of pieces that have the labels of their patches.
std::vector<int> labels_of_pieces(const std::vector<int>& piece_of_patch, int pieces,
                                  const std::vector<int>& label_of_patch) {
    std::vector<int> labels(at(pieces), 0);
    for (std::size_t i = 0; i < piece_of_patch.size(); ++i) labels[at(piece_of_patch[i])] = label_of_patch[i];
    return labels;
}

/// The tree over the pieces in which clusters of patches and the parts of the finest known level divide each
/// other. Collective.
PartTree tree_of(const Comm& comm, const PartitionEvidence& evidence, const CutOptions& options,
                 const std::vector<int>& part_of_patch, const std::vector<int>& cluster_of_patch) {
    PartitionsByNumber levels =
        nested_levels(part_of_patch, options.parts, options.guides, evidence.patch_area);
    const std::vector<int>& finest_known = levels.empty() ? part_of_patch : levels.back();
    const int known = 1 + *std::max_element(finest_known.begin(), finest_known.end());
    std::vector<int> pieces;
    for (std::size_t i = 0; i < part_of_patch.size(); ++i)
        pieces.push_back(cluster_of_patch[i] * known + finest_known[i]);
    pieces = renumbered(pieces);
    const int count = 1 + *std::max_element(pieces.begin(), pieces.end());
    const std::vector<int> part_of_piece = labels_of_pieces(pieces, count, part_of_patch);
    for (std::vector<int>& level : levels) level = labels_of_pieces(pieces, count, level);
    const PartitionObjective objective = partition_objective(comm, evidence, options.choice);
    PartTree tree =
        part_tree(cluster_sums(objective, pieces, count), part_of_piece, options.finest_level, levels);
    for (int& piece : pieces) piece = tree.piece_of_patch[at(piece)];
    tree.piece_of_patch = std::move(pieces);
    return tree;
}

CutResult described(const CutInput& input, int parts, const PositionFrame& frame, Found found) {
    CutResult result;
    PartitionCandidate& chosen = found.candidates[found.chosen];
    result.chosen = static_cast<int>(found.chosen);
    result.part_of_patch = std::move(chosen.labels);
    result.eigenvalues = std::move(chosen.eigenvalues);
    result.residuals = std::move(chosen.residuals);
    for (PartitionCandidate& r : found.candidates) result.starts.push_back(std::move(r.outcome));
    result.frame = frame;
    result.confidence = std::move(found.confidence);
    describe_parts(input.mesh_of, input.patch_area, parts, result);
    return result;
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

void describe_parts(const std::vector<int>& mesh_of, const std::vector<double>& patch_area, int parts,
                    CutResult& result) {
    result.part_share = mean_area_shares(result.part_of_patch, parts, patch_area, mesh_of);
    result.meshes_with_part = count_meshes(result.part_of_patch, mesh_of, parts);
}

CutGraphs cut_graphs(const Comm& comm, const CutInput& input, const CutOptions& options) {
    // At most: an entry and its transpose may fall together, never apart.
    const std::int64_t entries = 2 * all_sum(comm, static_cast<std::int64_t>(input.coefficients.rows.size()));
    const auto patches = static_cast<int>(input.mesh_of.size());
    CutGraphs cut;
    cut.one_rank = entries <= options.one_rank_entries;
    cut.links_count = cut.one_rank && options.choice.links > 0.0;
    cut.neighbors = gather_patch_pairs(comm, input.neighbors_local, patches);
    cut.overlaps = gather_patch_pairs(comm, input.overlaps_local, patches);
    const GraphOptions graphs{.form = options.form,
                              .minima_rule = options.minima_rule,
                              .placed = asks_for_positions(options.starts),
                              .complete = cut.one_rank};
    cut.terms = graph_terms(comm, base_affinity(comm, input.coefficients, cut.neighbors, graphs),
                            {cut.neighbors, cut.overlaps, input.mesh_of, input.positions}, graphs);
    return cut;
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
    if (options.parts == 1) {
        CutResult result;
        result.part_of_patch.assign(input.mesh_of.size(), 0);
        describe_parts(input.mesh_of, input.patch_area, 1, result);
        return result;
    }
    const auto [neighbors, overlaps, terms, one_rank, links_count] = cut_graphs(comm, input, options);
    const GraphInput graphs{neighbors, overlaps, input.mesh_of, input.positions};
    const PartitionEvidence evidence{
        neighbors,     overlaps,         input.descriptors,
        input.mesh_of, input.patch_area, links_count ? std::optional(terms.base.view()) : std::nullopt};
    const ClusteringTask all_starts{graphs,       terms, options.starts, options.spectral, options.drop_below,
                                    options.parts};
    const std::vector<CutStart> starts =
        promising_starts(comm, all_starts, evidence, options.choice, options.screening);
    const ClusteringTask clustering{graphs,       terms, starts, options.spectral, options.drop_below,
                                    options.parts};
    std::vector<PartitionCandidate> clusters = start_clusterings(comm, clustering, one_rank);
    Found found = input.examples == nullptr
                      ? found_alone(comm, evidence, options, std::move(clusters))
                      : found_by_examples(comm, input, {evidence, terms.frame}, options, std::move(clusters));
    CutResult result = described(input, options.parts, terms.frame, std::move(found));
    result.starts_left_out = static_cast<int>(options.starts.size() - starts.size());
    if (options.starts.size() > 1 && input.features != nullptr && !input.features->empty())
        result.scores = part_scores(
            comm, {*input.features, input.positions, terms.frame, input.patch_area, input.mesh_of},
            result.part_of_patch, options.parts);
    if (options.finest_level > 0 && has_all_parts(result)) {
        const std::vector<CutStart> fine = {
            {result.starts[at(result.chosen)].start.graph, std::max(options.finest_level, options.parts)}};
        const ClusteringTask finer{graphs, terms, fine, options.spectral, options.drop_below, options.parts};
        result.tree =
            tree_of(comm, evidence, options, result.part_of_patch,
                    all_gather_records(comm, start_clusterings(comm, finer, one_rank)).front().labels);
    }
    return result;
}

}  // namespace coseg
