#pragma once
// Where patches lie in the common frame of a collection, also those of shapes of which nobody knows how they
// stand.

#include <Eigen/Core>
#include <vector>

#include "solvers/subspace/coefficients.hpp"
#include "src/parallel/comm.hpp"
#include "src/records/shape_alignment.hpp"

namespace coseg {

/// The positions of all patches, 3 x N, turned as turned_positions does it. A patch of a shape that is not
/// found lies where the patches of found shapes lie that its column of W consists of: at their mean, weighted
/// by ||w_ij||, or at the centre where there are none. Where links disagree this is near the centre, and says
/// little. `positions` and `mesh_of` are those of all patches, the same on all ranks. The result has the same
/// bits on any number of ranks. Collective.
///
/// Deviates: this is not in the paper, which knows no positions.
Eigen::Matrix3Xd linked_positions(const Comm& comm, const ShapeAlignment& alignment,
                                  const SparseCoefficients& coefficients, const Eigen::Matrix3Xd& positions,
                                  const std::vector<int>& mesh_of);

}  // namespace coseg
