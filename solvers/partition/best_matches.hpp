#pragma once
// Links without an optimisation: each patch's best match in every other mesh.

#include <Eigen/Core>
#include <vector>

#include "solvers/subspace/coefficients.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

/// For each patch j and each OTHER mesh the patch i of it with the largest sum_h x_hi . x_hj (ties: the
/// lowest i), with that similarity as its one coefficient, so that normalized_links takes it in place of the
/// optimum. Similarities of 0 are left out. `features`: H matrices d_h x N, the same on all ranks; `mesh_of`:
/// mesh 0 .. M-1 of each patch, ascending. Each rank works on its own columns and nothing is communicated.
/// Deviates: not in the paper; a screen to compare the optimisation with.
SparseCoefficients best_matches(const Comm& comm, const std::vector<Eigen::MatrixXd>& features,
                                const std::vector<int>& mesh_of);

}  // namespace coseg
