#pragma once
// The things that the solves and cuts of one run have in common, whether they are of the whole collection, of
// subsets or of segments.

#include "mpi_drivers/options/stage_options.hpp"
#include "mpi_drivers/partition/partition_checkpoint.hpp"
#include "solvers/partition/labelled_parts.hpp"
#include "solvers/subspace/solver_checkpoint.hpp"

namespace coseg {

struct PartitionTask {
    const OptimiseOptions& optimise;
    const PartitionOptions& partition;
    const ExampleLabels& examples;        ///< empty where there are none
    SolverCheckpoint* tiles = nullptr;    ///< null where no state is kept
    PartitionCheckpoint* cuts = nullptr;  ///< likewise
};

}  // namespace coseg
