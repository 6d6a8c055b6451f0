#pragma once
// The terms of the graphs of a cut, complete, and what is made of them: starts and the choice.

#include <vector>

#include "solvers/affinity/global_patch_pairs.hpp"
#include "solvers/choice/partition_terms.hpp"
#include "solvers/partition/cut_graphs.hpp"
#include "solvers/partition/cut_input.hpp"
#include "solvers/partition/start_clusterings.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

/// What it makes refers to itself and to the input.
struct PreparedCut {
    std::vector<GlobalPatchNeighbors> neighbors;  ///< of all meshes
    std::vector<GlobalPatchOverlap> overlaps;     ///< likewise
    GraphTerms terms;
    bool one_rank = true;      ///< whether a graph is small enough for one rank, and `terms` are complete
    bool links_count = false;  ///< whether the choice counts links

    [[nodiscard]] GraphInput graph_input(const CutInput& input) const;
    [[nodiscard]] PartitionEvidence evidence(const CutInput& input) const;
    [[nodiscard]] ClusteringTask clustering(const CutInput& input, const CutOptions& options,
                                            const std::vector<CutStart>& starts) const;
};

/// Collective. Throws AgreedError.
PreparedCut prepared_cut(const Comm& comm, const CutInput& input, const CutOptions& options);

}  // namespace coseg
