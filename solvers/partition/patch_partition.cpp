#include "solvers/partition/patch_partition.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "solvers/choice/part_shares.hpp"
#include "solvers/choice/partition_objective.hpp"
#include "solvers/partition/found_partition.hpp"
#include "solvers/partition/part_levels.hpp"
#include "solvers/partition/part_scores.hpp"
#include "solvers/partition/partition_by_examples.hpp"
#include "solvers/partition/prepared_cut.hpp"
#include "solvers/partition/start_clusterings.hpp"
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

/// The tree over the pieces in which clusters of patches in the chosen graph and the parts of the finest
/// known level divide each other. Collective.
PartTree tree_of(const Comm& comm, const CutInput& input, const CutOptions& options, const PreparedCut& cut,
                 const CutResult& result) {
    const std::vector<CutStart> fine = {
        {result.starts[at(result.chosen)].start.graph, std::max(options.finest_level, options.parts)}};
    const std::vector<int> cluster_of_patch =
        all_gather_records(comm, start_clusterings(comm, cut.clustering(input, options, fine), cut.one_rank))
            .front()
            .labels;
    return part_tree_of_patches(
        partition_objective(comm, cut.evidence(input), options.choice), result.part_of_patch,
        cluster_of_patch,
        nested_levels(result.part_of_patch, options.parts, options.guides, input.patch_area),
        options.finest_level);
}

CutResult described(const CutInput& input, int parts, const PositionFrame& frame, FoundPartition found) {
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
    const PreparedCut cut = prepared_cut(comm, input, options);
    const PartitionEvidence evidence = cut.evidence(input);
    const std::vector<CutStart> starts = promising_starts(
        comm, cut.clustering(input, options, options.starts), evidence, options.choice, options.screening);
    std::vector<PartitionCandidate> clusters =
        start_clusterings(comm, cut.clustering(input, options, starts), cut.one_rank);
    FoundPartition found =
        input.examples == nullptr
            ? found_alone(comm, evidence, options, std::move(clusters))
            : found_by_examples(comm, input, {evidence, cut.terms.frame}, options, std::move(clusters));
    CutResult result = described(input, options.parts, cut.terms.frame, std::move(found));
    result.starts_left_out = static_cast<int>(options.starts.size() - starts.size());
    if (options.starts.size() > 1 && input.features != nullptr && !input.features->empty())
        result.scores = part_scores(
            comm, {*input.features, input.positions, cut.terms.frame, input.patch_area, input.mesh_of},
            result.part_of_patch, options.parts);
    if (options.finest_level > 0 && has_all_parts(result))
        result.tree = tree_of(comm, input, options, cut, result);
    return result;
}

}  // namespace coseg
