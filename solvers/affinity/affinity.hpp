#pragma once
// From coefficients and relations of patches to the affinity that is cut.

#include <vector>

#include "solvers/affinity/global_patch_pairs.hpp"
#include "solvers/affinity/sparse_rows.hpp"
#include "solvers/subspace/coefficients.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

/// S_ij = 1/2 (||w_ij||_2 + ||w_ji||_2), w_ij the H coefficients of a pair. The transpose comes by one
/// exchange of entries. Collective. Source: the paper, equation (8).
SparseRows symmetric_affinity(const Comm& comm, const SparseCoefficients& coefficients);

/// C = B + B^T, B_ij = ||w_ij||_2 / sum_i ||w_ij||_2: what reconstructs a patch weighs the same for every
/// patch. Deviates: not in the paper. A column is the patch that chooses, so it is columns that are
/// normalised. Collective.
SparseRows normalized_links(const Comm& comm, const SparseCoefficients& coefficients);

/// S_ij <- S_ij (1 - mc) for patches i, j with a common boundary. `neighbors` as from gather_patch_pairs.
/// Source: the paper, the minima rule. Entries that do not exist stay so.
void apply_minima_rule(SparseRows& affinity, const std::vector<GlobalPatchNeighbors>& neighbors);

/// A_ij = boundary length (1 - mc)^5, each mesh scaled to a total of 1; rows `range`. `mesh_of`: mesh of each
/// patch. Deviates: not in the paper, whose minima rule only weakens entries that exist. The
/// exponent decides how much of A lies across the boundaries of true parts: with 3 and 5, 4.3 and 3.0 % on
/// aeroplanes, 6.4 and 5.4 % on pliers.
SparseRows adjacency_affinity(BlockRange range, const std::vector<GlobalPatchNeighbors>& neighbors,
                              const std::vector<int>& mesh_of);

/// O_ij = intersection over union of two patches of different over-segmentations; rows `range` of a matrix of
/// `size`. Deviates: the paper has one over-segmentation a mesh.
SparseRows overlap_affinity(BlockRange range, const std::vector<GlobalPatchOverlap>& overlaps,
                            std::int64_t size);

}  // namespace coseg
