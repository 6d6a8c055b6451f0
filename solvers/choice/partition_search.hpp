#pragma once
// The search for the partition with the best score: clusters are merged, and the best results improved.

#include <tuple>
#include <vector>

#include "solvers/choice/part_expansion.hpp"
#include "solvers/choice/partition_objective.hpp"
#include "src/parallel/comm.hpp"
#include "src/records/start_outcome.hpp"

namespace coseg {

/// What came of the start of this number: its clusters, then its parts.
struct PartitionCandidate {
    int index = 0;
    StartOutcome outcome;
    std::vector<int> labels;          ///< of patches: clusters, then parts
    std::vector<double> eigenvalues;  ///< as in CutResult
    std::vector<double> residuals;    ///< likewise
    static constexpr auto fields() {
        return std::tuple(field("index", &PartitionCandidate::index),
                          field("outcome", &PartitionCandidate::outcome),
                          field("labels", &PartitionCandidate::labels),
                          field("eigenvalues", &PartitionCandidate::eigenvalues),
                          field("residuals", &PartitionCandidate::residuals));
    }
};

/// What all steps of a search look at, the same on all ranks.
struct SearchTask {
    const PartitionEvidence& evidence;
    const PartitionObjective& objective;  ///< of the evidence
    const ChoiceWeights& weights;
    int parts = 2;
};

/// All starts, merged into parts in the way with the best score, in the order of their numbers; the best of
/// them are improved by moves of single patches. Parts are numbered by canonical_labels. `clusterings` are
/// those of this rank. Collective.
std::vector<PartitionCandidate> search_partitions(const Comm& comm, const SearchTask& task,
                                                  std::vector<PartitionCandidate> clusterings);

/// The numbers of the candidates, the best first: those with the most parts that are not degenerate, or all
/// with the most parts if there is none, by falling score; then the others likewise. Of equal ones the first.
std::vector<std::size_t> ranked_candidates(const std::vector<PartitionCandidate>& candidates);

/// The candidate after expansions of its parts (climb_by_expansion). Degenerate parts come of these only
/// where there were some. Collective.
PartitionCandidate expanded(const Comm& comm, const SearchTask& task, PartitionCandidate outcome);

/// The candidate with other labels, which are kept as they are numbered, and what they come to.
PartitionCandidate relabelled(const SearchTask& task, PartitionCandidate candidate, std::vector<int> labels);

}  // namespace coseg
