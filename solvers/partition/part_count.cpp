#include "solvers/partition/part_count.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "solvers/choice/cluster_merging.hpp"
#include "solvers/choice/part_shares.hpp"
#include "solvers/choice/patch_moves.hpp"
#include "solvers/partition/partition_agreement.hpp"
#include "solvers/partition/prepared_cut.hpp"
#include "solvers/partition/start_clusterings.hpp"
#include "src/base/index.hpp"
#include "src/base/text.hpp"
#include "src/parallel/record_exchange.hpp"

namespace coseg {

namespace {

/// A partition into so many parts.
struct CountedPartition {
    int parts = 0;
    PartitionCandidate candidate;
    static constexpr auto fields() {
        return std::tuple(field("parts", &CountedPartition::parts),
                          field("candidate", &CountedPartition::candidate));
    }
};

/// What all numbers of parts are judged by, the same on all ranks.
struct CountTask {
    const PartitionEvidence& evidence;
    const PartitionObjective& objective;
    const ChoiceWeights& weights;
};

/// Each graph once, cut into few, some and many clusters.
std::vector<CutStart> counting_starts(const std::vector<CutStart>& starts) {
    std::vector<CutStart> result;
    for (const CutStart& start : starts) {
        const bool is_known = std::any_of(result.begin(), result.end(),
                                          [&](const CutStart& r) { return r.graph == start.graph; });
        if (is_known) continue;
        for (const int clusters : {8, 14, 24}) result.push_back({start.graph, clusters});
    }
    return result;
}

void describe_counted(const CountTask& task, CountedPartition& partition) {
    PartitionCandidate& candidate = partition.candidate;
    const PartitionEvidence& evidence = task.evidence;
    candidate.labels =
        canonical_labels(candidate.labels, partition.parts, evidence.patch_area, evidence.mesh_of);
    candidate.outcome.terms = partition_terms(evidence, candidate.labels, partition.parts);
    candidate.outcome.score = partition_score(candidate.outcome.terms, task.weights, evidence.descriptors);
}

/// The clusters merged into every number of parts, in the best of the ways that merging proposes.
std::vector<CountedPartition> merged_into_all_numbers(const CountTask& task,
                                                      const PartitionCandidate& clustering) {
    const int clusters = 1 + *std::max_element(clustering.labels.begin(), clustering.labels.end());
    const ClusterSums sums = cluster_sums(task.objective, clustering.labels, clusters);
    std::vector<CountedPartition> all;
    for (int parts = least_part_count; parts <= largest_part_count && 3 * parts <= 2 * clusters; ++parts) {
        std::optional<CountedPartition> best;
        for (const std::vector<int>& part_of : merge_clusters(sums, parts)) {
            CountedPartition tried{parts, clustering};
            for (int& label : tried.candidate.labels) label = part_of[at(label)];
            describe_counted(task, tried);
            if (!best || tried.candidate.outcome.score > best->candidate.outcome.score)
                best = std::move(tried);
        }
        all.push_back(*std::move(best));
    }
    return all;
}

/// The best partition of each graph into so many parts, by falling score; of equal ones the first start.
std::vector<PartitionCandidate> best_of_graphs(const std::vector<CountedPartition>& all, int parts) {
    std::vector<PartitionCandidate> sorted;
    for (const CountedPartition& p : all) {
        if (p.parts == parts) sorted.push_back(p.candidate);
    }
    std::sort(sorted.begin(), sorted.end(), [](const PartitionCandidate& a, const PartitionCandidate& b) {
        if (a.outcome.score != b.outcome.score) return a.outcome.score > b.outcome.score;
        return a.index < b.index;
    });
    std::vector<PartitionCandidate> best;
    for (PartitionCandidate& candidate : sorted) {
        const bool is_known = std::any_of(best.begin(), best.end(), [&](const PartitionCandidate& b) {
            return b.outcome.start.graph == candidate.outcome.start.graph;
        });
        if (!is_known) best.push_back(std::move(candidate));
    }
    return best;
}

/// 1 where there is one graph alone.
double agreement_of_graphs(const std::vector<PartitionCandidate>& best, int parts,
                           const std::vector<double>& area) {
    if (best.size() < 2) return 1.0;
    double sum = 0.0;
    for (std::size_t g = 1; g < best.size(); ++g)
        sum += adjusted_rand_index(common_areas(best.front().labels, parts, best[g].labels, parts, area));
    return sum / static_cast<double>(best.size() - 1);
}

/// The partitions after moves of single patches, dealt over the ranks. Collective.
std::vector<CountedPartition> moved_partitions(const Comm& comm, const CountTask& task,
                                               const std::vector<CountedPartition>& partitions) {
    std::vector<CountedPartition> mine;
    for (auto k = at(comm.rank()); k < partitions.size(); k += at(comm.size())) {
        CountedPartition moved = partitions[k];
        moved.candidate.labels =
            move_patches(task.objective, std::move(moved.candidate.labels), moved.parts).labels;
        describe_counted(task, moved);
        mine.push_back(std::move(moved));
    }
    return all_gather_records(comm, mine);
}

/// A part whose share of a mesh is below this is not in it.
constexpr double noticed_share = 0.002;

/// All figures but the agreement.
PartCountFigures figures_of(const CountTask& task, const PartitionCandidate& partition, int parts) {
    const Eigen::MatrixXd shares =
        area_shares(partition.labels, parts, task.evidence.patch_area, task.evidence.mesh_of);
    PartCountFigures figures{.parts = parts, .score = partition.outcome.score};
    figures.least_share = shares.rowwise().mean().minCoeff();
    const Eigen::VectorXd present = (shares.array() > noticed_share).cast<double>().rowwise().mean();
    figures.rarest = present.minCoeff();
    return figures;
}

CountedParts counted_parts(const Comm& comm, const CountTask& task,
                           const std::vector<CountedPartition>& all) {
    std::vector<CountedPartition> finalists;
    std::vector<PartCountFigures> agreements;
    for (int parts = least_part_count; parts <= largest_part_count; ++parts) {
        const std::vector<PartitionCandidate> best = best_of_graphs(all, parts);
        for (std::size_t g = 0; g < std::min<std::size_t>(2, best.size()); ++g)
            finalists.push_back({parts, best[g]});
        if (!best.empty())
            agreements.push_back(
                {.parts = parts, .agreement = agreement_of_graphs(best, parts, task.evidence.patch_area)});
    }
    const std::vector<CountedPartition> moved = moved_partitions(comm, task, finalists);
    CountedParts result;
    for (const PartCountFigures& known : agreements) {
        PartitionCandidate best = best_of_graphs(moved, known.parts).front();
        PartCountFigures figures = figures_of(task, best, known.parts);
        figures.agreement = known.agreement;
        figures.merit =
            figures.score + worth_of_agreement * figures.agreement - price_of_part * figures.parts;
        result.figures.push_back(figures);
        result.partitions.push_back(std::move(best.labels));
    }
    std::stable_sort(result.figures.begin(), result.figures.end(),
                     [](const PartCountFigures& a, const PartCountFigures& b) { return a.merit > b.merit; });
    return result;
}

std::string signed_decimal(double value) { return (value < 0.0 ? "" : "+") + decimal(value, 1); }

/// Why `other` comes after `chosen`.
std::string reason(const PartCountFigures& chosen, const PartCountFigures& other) {
    return std::to_string(other.parts) + " (behind by " + decimal(chosen.merit - other.merit, 2) +
           ": score " + signed_decimal(other.score - chosen.score) + ", starts agree to " +
           decimal(other.agreement, 2) + ", smallest part " + percent(other.least_share, 1) +
           " of the area, rarest in " + percent(other.rarest, 0) + " of the shapes)";
}

}  // namespace

CountedParts count_parts(const Comm& comm, const CutInput& input, CutOptions options) {
    options.parts = least_part_count;
    options.starts = counting_starts(options.starts);
    const PreparedCut cut = prepared_cut(comm, input, options);
    const PartitionEvidence evidence = cut.evidence(input);
    const PartitionObjective objective = partition_objective(comm, evidence, options.choice);
    const CountTask task{evidence, objective, options.choice};
    std::vector<CountedPartition> mine;
    for (const PartitionCandidate& clustering :
         start_clusterings(comm, cut.clustering(input, options, options.starts), cut.one_rank)) {
        for (CountedPartition& merged : merged_into_all_numbers(task, clustering))
            mine.push_back(std::move(merged));
    }
    return counted_parts(comm, task, all_gather_records(comm, mine));
}

bool is_clear(const std::vector<PartCountFigures>& by_merit) {
    return by_merit.size() < 2 || by_merit[0].merit - by_merit[1].merit > price_of_part;
}

std::string part_count_sentence(const std::vector<PartCountFigures>& by_merit) {
    const PartCountFigures& chosen = by_merit.front();
    std::string text = with_unit(chosen.parts, "part", "parts") + " (starts agree to " +
                       decimal(chosen.agreement, 2) + ", smallest part " + percent(chosen.least_share, 1) +
                       " of the area, rarest in " + percent(chosen.rarest, 0) + " of the shapes)";
    if (by_merit.size() > 1) text += "; next are " + reason(chosen, by_merit[1]);
    if (by_merit.size() > 2) text += " and " + reason(chosen, by_merit[2]);
    if (!is_clear(by_merit))
        text += "; nothing is clear: " + std::to_string(by_merit[1].parts) + " are nearly as good";
    return text;
}

}  // namespace coseg
