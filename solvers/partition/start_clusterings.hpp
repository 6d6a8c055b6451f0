#pragma once
// Cuts the graphs of the starts into clusters, graphs or single products shared out among the ranks.

#include <vector>

#include "solvers/choice/partition_search.hpp"
#include "solvers/partition/cut_graphs.hpp"
#include "solvers/spectral/spectral_embedding.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

/// What the cuts of all starts have in common.
struct ClusteringTask {
    GraphInput graphs;
    const GraphTerms& terms;
    const std::vector<CutStart>& starts;
    const SpectralOptions& spectral;
    double drop_below = 0.0;  ///< entries of a graph below are dropped
    int parts = 2;
};

/// The clusterings that this rank goes on with; all ranks together have one for each start. With `one_rank`
/// graphs are dealt over the ranks, and each is cut by one of them, which needs complete terms. Otherwise one
/// graph after the other is cut by all ranks. The clusters are the same in both cases, numbered 0, 1, ...
/// without gaps. Collective. Throws AgreedError(not_converged).
std::vector<PartitionCandidate> start_clusterings(const Comm& comm, const ClusteringTask& task,
                                                  bool one_rank);

}  // namespace coseg
