#pragma once
// The partition that a search takes, among all that it has found.

#include <cstddef>
#include <vector>

#include "solvers/choice/partition_search.hpp"
#include "solvers/partition/cut_input.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

/// All candidates, and the number of the one that is taken.
struct FoundPartition {
    std::vector<PartitionCandidate> candidates;
    std::size_t chosen = 0;
    std::vector<double> confidence;  ///< see CutResult
};

/// The one of the highest score of those that a search makes of the clusterings. Collective.
FoundPartition found_by_search(const Comm& comm, const SearchTask& task,
                               std::vector<PartitionCandidate> clusterings);

/// The same; where there are several starts, it is improved by expansions, and has a confidence. Collective.
FoundPartition found_and_expanded(const Comm& comm, const SearchTask& task, const CutOptions& options,
                                  std::vector<PartitionCandidate> clusterings);

/// The same, of a cut without examples. Collective.
FoundPartition found_alone(const Comm& comm, const PartitionEvidence& evidence, const CutOptions& options,
                           std::vector<PartitionCandidate> clusterings);

}  // namespace coseg
