#pragma once
// From features to parts: the coefficients of equations (6) and (7), their affinity of equation (8), and its
// cut.

#include "mpi_drivers/describe/feature_stage.hpp"
#include "mpi_drivers/describe/mesh_stage.hpp"
#include "mpi_drivers/optimise/optimise_stage.hpp"
#include "mpi_drivers/partition/partition_task.hpp"
#include "solvers/partition/patch_partition.hpp"
#include "src/parallel/comm.hpp"
#include "src/parallel/stage_log.hpp"
#include "src/records/shape_alignment.hpp"

namespace coseg {

struct Partitioned {
    Optimisation optimisation;
    CutResult cut;
    ShapeAlignment alignment;
    Eigen::Matrix3Xd positions;  ///< of all patches, see linked_positions
};

/// Throws AgreedError(input) where there are fewer patches than parts.
void refuse_too_many_parts(const Collection& collection, int parts);

/// Optimises and cuts the collection whole, or in subsets where it is larger than these; then, if asked for,
/// once more with the segments that came out in place of patches. The log has the stages "optimise", "align"
/// and "cut", or "subsets", and "segments". Collective. Throws AgreedError: input where W = 0 leaves nothing
/// to cut; what optimise, the cut and the checkpoints throw.
Partitioned partition_stage(const Comm& comm, const Collection& collection, PatchFeatures features,
                            const PartitionTask& task, StageLog& log);

}  // namespace coseg
