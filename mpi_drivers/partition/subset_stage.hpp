#pragma once
// Optimises and cuts a collection in overlapping subsets and reconciles their parts: the paper's device for
// large collections, to compare with solving it whole.

#include "mpi_drivers/optimise/optimise_stage.hpp"
#include "mpi_drivers/partition/cut_stage.hpp"
#include "mpi_drivers/partition/partition_task.hpp"

namespace coseg {

struct SubsetOutcome {
    /// Objectives and bounds are sums over the subsets; gap, residual and iterations are the largest. The
    /// coefficients of a common mesh's patches are those of the first subset.
    Optimisation optimisation;
    CutResult cut;  ///< of all patches; without starts
};

/// Optimises and cuts subsets of task.partition.subsets meshes one after the other, on all ranks. Each subset
/// is aligned for its own cut. Parts of a later subset take the numbers of the first by the one assignment
/// that agrees on most area of the common meshes. Features are those of the whole collection. Source: the
/// paper, section 5 (Figure 6). Collective. Throws what optimise and cut_into_parts do, and what the
/// checkpoints do.
SubsetOutcome partition_subsets(const Comm& comm, const Collection& collection, const PatchFeatures& features,
                                const PartitionTask& task);

}  // namespace coseg
