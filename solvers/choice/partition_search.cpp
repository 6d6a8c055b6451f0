#include "solvers/choice/partition_search.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "solvers/choice/cluster_merging.hpp"
#include "solvers/choice/part_exchange.hpp"
#include "solvers/choice/part_shares.hpp"
#include "solvers/choice/patch_moves.hpp"
#include "src/base/index.hpp"
#include "src/parallel/record_exchange.hpp"

namespace coseg {

namespace {

/// Partitions that are improved by moves of single patches: those with the best scores.
constexpr std::size_t finalists = 12;

/// Finds terms and score of the labels.
void describe_labels(const SearchTask& task, PartitionCandidate& result) {
    const PartitionEvidence& evidence = task.evidence;
    const Eigen::MatrixXd shares =
        area_shares(result.labels, task.parts, evidence.patch_area, evidence.mesh_of);
    StartOutcome& outcome = result.outcome;
    outcome.parts_found = static_cast<int>((shares.rowwise().maxCoeff().array() > 0.0).count());
    outcome.degenerate = is_degenerate(shares);
    outcome.terms = partition_terms(evidence, result.labels, task.parts);
    outcome.score = partition_score(outcome.terms, task.weights, evidence.descriptors);
}

/// The same after the parts are numbered, so that partitions that are the same have the same terms to the
/// last bit.
void describe_outcome(const SearchTask& task, PartitionCandidate& result) {
    result.labels =
        canonical_labels(result.labels, task.parts, task.evidence.patch_area, task.evidence.mesh_of);
    describe_labels(task, result);
}

/// Partitions without degenerate parts are better than those with some, and of two alike the one with the
/// higher score is.
bool is_better(const StartOutcome& a, const StartOutcome& b) {
    return a.degenerate != b.degenerate ? b.degenerate : a.score > b.score;
}

/// Merges the clusters into parts in several ways, of which the best is taken.
PartitionCandidate merged(const SearchTask& task, const PartitionCandidate& clustering) {
    const int clusters = 1 + *std::max_element(clustering.labels.begin(), clustering.labels.end());
    if (clusters <= task.parts) {
        PartitionCandidate same = clustering;
        describe_outcome(task, same);
        return same;
    }
    const ClusterSums sums = cluster_sums(task.objective, clustering.labels, clusters);
    std::optional<PartitionCandidate> best;
    for (const std::vector<int>& part_of : merge_clusters(sums, task.parts)) {
        PartitionCandidate result = clustering;
        for (int& label : result.labels) label = part_of[at(label)];
        describe_outcome(task, result);
        if (!best || is_better(result.outcome, best->outcome)) best = std::move(result);
    }
    return std::move(*best);
}

/// The outcome after exchanges of parts and moves of single patches, or the same one where these raise the
/// objective but, as it leaves out a term, not the score.
PartitionCandidate improved(const SearchTask& task, PartitionCandidate outcome) {
    MovedPatches moved =
        move_patches(task.objective, exchange_parts(task.objective, outcome.labels, task.parts), task.parts);
    PartitionCandidate after = outcome;
    after.labels = std::move(moved.labels);
    after.outcome.moved = moved.moved;
    describe_outcome(task, after);
    const bool helps =
        after.outcome.score > outcome.outcome.score && after.outcome.degenerate <= outcome.outcome.degenerate;
    return helps ? std::move(after) : std::move(outcome);
}

/// Outcomes with the most parts, none of them degenerate; or, if there are none, the others with the most.
std::vector<char> eligible_outcomes(const std::vector<PartitionCandidate>& outcomes) {
    int most = 0;
    for (const PartitionCandidate& r : outcomes) most = std::max(most, r.outcome.parts_found);
    std::vector<char> eligible;
    bool any = false;
    for (const PartitionCandidate& r : outcomes) {
        eligible.push_back(r.outcome.parts_found == most && !r.outcome.degenerate ? 1 : 0);
        any = any || eligible.back() != 0;
    }
    for (std::size_t k = 0; k < outcomes.size() && !any; ++k)
        eligible[k] = outcomes[k].outcome.parts_found == most ? 1 : 0;
    return eligible;
}

/// The different partitions among the best.
std::vector<std::size_t> best_outcomes(const std::vector<PartitionCandidate>& outcomes) {
    std::vector<std::size_t> best;
    for (const std::size_t k : ranked_candidates(outcomes)) {
        const bool is_new = std::none_of(best.begin(), best.end(), [&](std::size_t other) {
            return outcomes[other].labels == outcomes[k].labels;
        });
        if (is_new) best.push_back(k);
        if (best.size() == finalists) break;
    }
    return best;
}

}  // namespace

std::vector<PartitionCandidate> search_partitions(const Comm& comm, const SearchTask& task,
                                                  std::vector<PartitionCandidate> clusterings) {
    for (PartitionCandidate& r : clusterings) r = merged(task, r);
    std::vector<PartitionCandidate> outcomes = all_gather_records(comm, clusterings);
    std::sort(outcomes.begin(), outcomes.end(),
              [](const PartitionCandidate& a, const PartitionCandidate& b) { return a.index < b.index; });
    if (outcomes.size() == 1) return outcomes;
    const std::vector<std::size_t> best = best_outcomes(outcomes);
    std::vector<PartitionCandidate> mine;
    for (auto k = at(comm.rank()); k < best.size(); k += at(comm.size()))
        mine.push_back(improved(task, outcomes[best[k]]));
    for (PartitionCandidate& r : all_gather_records(comm, mine)) outcomes[at(r.index)] = std::move(r);
    return outcomes;
}

std::vector<std::size_t> ranked_candidates(const std::vector<PartitionCandidate>& candidates) {
    const std::vector<char> eligible = eligible_outcomes(candidates);
    std::vector<std::size_t> order(candidates.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        if (eligible[a] != eligible[b]) return eligible[a] > eligible[b];
        return candidates[a].outcome.score > candidates[b].outcome.score;
    });
    return order;
}

PartitionCandidate relabelled(const SearchTask& task, PartitionCandidate candidate, std::vector<int> labels) {
    candidate.labels = std::move(labels);
    describe_labels(task, candidate);
    return candidate;
}

PartitionCandidate expanded(const Comm& comm, const SearchTask& task, PartitionCandidate outcome) {
    const auto score = [&](const std::vector<int>& labels) {
        const StartOutcome tried = relabelled(task, outcome, labels).outcome;
        const bool is_worse =
            tried.parts_found < outcome.outcome.parts_found || tried.degenerate > outcome.outcome.degenerate;
        return is_worse ? -std::numeric_limits<double>::infinity() : tried.score;
    };
    outcome.labels =
        climb_by_expansion(comm, task.objective, {}, outcome.labels, task.parts, {score, falling_inertias});
    describe_outcome(task, outcome);
    return outcome;
}

}  // namespace coseg
