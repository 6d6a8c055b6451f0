#pragma once
// Gathers columns of patches, which are computed where their mesh is, on every rank in the global order of
// patches.

#include <Eigen/Core>
#include <vector>

#include "mpi_drivers/describe/mesh_stage.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

/// local[k] is rows x numbering.count(mesh of collection.local[k]): the columns of one mesh's patches, its
/// over-segmentations in order. Returns rows x N on every rank. Collective; `rows` must be the same on every
/// rank.
Eigen::MatrixXd gather_patch_columns(const Comm& comm, const Collection& collection,
                                     const std::vector<Eigen::MatrixXd>& local, Eigen::Index rows);

}  // namespace coseg
