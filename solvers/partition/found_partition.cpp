#include "solvers/partition/found_partition.hpp"

#include <utility>

#include "solvers/partition/part_confidence.hpp"

namespace coseg {

FoundPartition found_by_search(const Comm& comm, const SearchTask& task,
                               std::vector<PartitionCandidate> clusterings) {
    FoundPartition found;
    found.candidates = search_partitions(comm, task, std::move(clusterings));
    found.chosen = ranked_candidates(found.candidates).front();
    return found;
}

FoundPartition found_and_expanded(const Comm& comm, const SearchTask& task, const CutOptions& options,
                                  std::vector<PartitionCandidate> clusterings) {
    FoundPartition found = found_by_search(comm, task, std::move(clusterings));
    PartitionCandidate& chosen = found.candidates[found.chosen];
    if (options.starts.size() > 1) {
        chosen = expanded(comm, task, std::move(chosen));
        found.confidence = part_confidence(task.objective, {}, chosen.labels, task.parts);
    }
    return found;
}

FoundPartition found_alone(const Comm& comm, const PartitionEvidence& evidence, const CutOptions& options,
                           std::vector<PartitionCandidate> clusterings) {
    const PartitionObjective objective = partition_objective(comm, evidence, options.choice);
    return found_and_expanded(comm, {evidence, objective, options.choice, options.parts}, options,
                              std::move(clusterings));
}

}  // namespace coseg
