#pragma once
// Aligns the shapes of a collection by the links between their patches.

#include "mpi_drivers/describe/feature_stage.hpp"
#include "mpi_drivers/describe/mesh_stage.hpp"
#include "mpi_drivers/options/stage_options.hpp"
#include "solvers/subspace/coefficients.hpp"
#include "src/parallel/comm.hpp"
#include "src/parallel/stage_log.hpp"
#include "src/records/shape_alignment.hpp"

namespace coseg {

/// The poses of the collection's shapes, see align_shapes. With AlignMode::off, or where patches have no
/// positions, nothing is done. Collective.
ShapeAlignment aligned(const Comm& comm, const Collection& collection, const PatchFeatures& features,
                       const SparseCoefficients& coefficients, const PartitionOptions& options);

/// The same, with the stage "align" in the log. Collective.
ShapeAlignment alignment_stage(const Comm& comm, const Collection& collection, const PatchFeatures& features,
                               const SparseCoefficients& coefficients, const PartitionOptions& options,
                               StageLog& log);

}  // namespace coseg
