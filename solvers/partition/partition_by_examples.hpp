#pragma once
// The partition of a cut in which some patches are said to have a part.

#include <vector>

#include "solvers/affinity/position_correlation.hpp"
#include "solvers/choice/partition_terms.hpp"
#include "solvers/partition/cut_input.hpp"
#include "solvers/partition/found_partition.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

/// The evidence of the cut, and the frame of its positions.
struct PlacedEvidence {
    const PartitionEvidence& evidence;
    const PositionFrame& frame;
};

/// From the partition without examples, the one that explains their scores, or the labels with the best
/// scores, whichever suits the examples best, to labels that follow them. Collective.
FoundPartition found_by_examples(const Comm& comm, const CutInput& input, const PlacedEvidence& placed,
                                 const CutOptions& options, std::vector<PartitionCandidate> clusterings);

}  // namespace coseg
