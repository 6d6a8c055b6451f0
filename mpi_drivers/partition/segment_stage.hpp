#pragma once
// The paper's optional second pass, on the whole segments that a first cut gave instead of patches.

#include "mpi_drivers/describe/feature_stage.hpp"
#include "mpi_drivers/partition/cut_stage.hpp"
#include "mpi_drivers/partition/partition_task.hpp"

namespace coseg {

/// The segments of a mesh are the connected pieces of one part, over neighbourhoods and overlaps of patches.
/// Their histograms are the area-weighted means of their patches' histograms (of the squares where histograms
/// are square-rooted, sums of counts). They are optimised and cut as patches are, and every patch takes the
/// part of its segment. `first` is the first pass, whose starts the result keeps. Source: the paper, section
/// 4. Collective. Throws as partition_subsets.
CutResult partition_segments(const Comm& comm, const Collection& collection, const PatchFeatures& features,
                             const CutResult& first, const PartitionTask& task);

}  // namespace coseg
