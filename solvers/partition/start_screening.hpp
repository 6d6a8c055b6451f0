#pragma once
// Leaves out the starts of a large collection that cannot win: all are tried on a sample of its meshes first.

#include <vector>

#include "solvers/choice/partition_terms.hpp"
#include "solvers/partition/start_clusterings.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

struct StartScreening {
    int meshes = 50;  ///< of the sample; with fewer than twice as many no start is left out
    int graphs = 4;   ///< whose starts are kept
};

/// The starts of `whole` that are worth the work. Of a large collection these are the starts of the few
/// graphs whose best partitions of a sample of the meshes have the highest scores, in the order of
/// whole.starts; otherwise all. A hash of the meshes' numbers decides which are in the sample. The same on
/// all ranks. Collective. Throws AgreedError(not_converged).
///
/// Deviates: the paper's code has one start. Source: none.
std::vector<CutStart> promising_starts(const Comm& comm, const ClusteringTask& whole,
                                       const PartitionEvidence& evidence, const ChoiceWeights& weights,
                                       StartScreening screening);

}  // namespace coseg
