#pragma once
// Measures whether linked patches have the same position in their meshes, for collections whose shapes stand
// alike.

#include <Eigen/Core>
#include <vector>

#include "solvers/affinity/sparse_rows.hpp"
#include "src/parallel/comm.hpp"
#include "src/records/position_frame.hpp"

namespace coseg {

/// `links` are this rank's rows of a symmetric affinity; those inside a mesh do not count. `positions` are
/// those of all patches, 3 x N, column major, each mesh centred and scaled in the same way. `mesh_of` is per
/// patch. Both are the same on all ranks. A common affine map of the positions changes neither the
/// correlations nor the factors of weigh_by_position. The result has the same bits on any number of ranks.
/// Collective. Source: canonical correlation analysis, Hotelling 1936.
PositionFrame position_frame(const Comm& comm, const SparseRows& links, const Eigen::Matrix3Xd& positions,
                             const std::vector<int>& mesh_of);

/// Multiplies each link between meshes by p(x, y) / (p(x) p(y)), where x and y are the positions of its ends
/// and p is their normal distribution with the correlations of the frame. The factor says how much likelier
/// the two positions are as ends of a link than by chance. Without correlation it is 1. Does not communicate.
/// Deviates: this is not in the paper, whose descriptors do not know where a patch lies.
void weigh_by_position(const PositionFrame& frame, const Eigen::Matrix3Xd& positions,
                       const std::vector<int>& mesh_of, SparseRows& links);

/// 3 x N: the coordinates of the positions in the frame, times their correlations over sqrt(3): places
/// count as far as shapes stand alike, and all three as much as one coordinate of spread 1. `positions` as
/// above; zeros where they are null.
Eigen::Matrix3Xd correlated_places(const PositionFrame& frame, const Eigen::Matrix3Xd* positions,
                                   Eigen::Index patches);

}  // namespace coseg
