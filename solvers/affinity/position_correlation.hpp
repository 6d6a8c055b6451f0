#pragma once
// Whether linked patches lie at the same place of their meshes, in collections whose shapes stand alike.

#include <Eigen/Core>
#include <vector>

#include "solvers/affinity/sparse_rows.hpp"
#include "src/parallel/comm.hpp"
#include "src/records/position_frame.hpp"

namespace coseg {

/// `links`: this rank's rows of a symmetric affinity; those inside a mesh do not count. `positions`: 3 x N, column major, of all
/// patches, each mesh centred and scaled alike; `mesh_of` per patch; both the same on all ranks. A common affine map of the
/// positions changes neither the correlations nor what weigh_by_position makes of them. The same bits on any number of ranks.
/// Collective. Source: canonical correlation analysis, Hotelling 1936.
PositionFrame position_frame(const Comm& comm, const SparseRows& links, const Eigen::Matrix3Xd& positions,
                             const std::vector<int>& mesh_of);

/// Each link between meshes times p(x, y) / (p(x) p(y)), x and y the positions of its ends and p their normal distribution with
/// the correlations of the frame: how much likelier the two are as ends of a link than side by side by chance. Without
/// correlation that is 1. Does not communicate.
/// Deviates: not in the paper, whose descriptors do not know where a patch lies.
void weigh_by_position(const PositionFrame& frame, const Eigen::Matrix3Xd& positions,
                       const std::vector<int>& mesh_of, SparseRows& links);

}  // namespace coseg
