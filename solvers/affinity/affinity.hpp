#pragma once
// Makes the affinity that is cut of the coefficients and of the pairs of patches that touch or overlap.

#include <vector>

#include "solvers/affinity/global_patch_pairs.hpp"
#include "solvers/affinity/sparse_rows.hpp"
#include "solvers/subspace/coefficients.hpp"
#include "src/base/enum_names.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

/// What the coefficients become.
enum class AffinityForm {
    links,      ///< every patch's own links sum to 1, see normalized_links; deviates
    formula_8,  ///< the paper's equation (8), see symmetric_affinity
};
constexpr std::array<EnumName<AffinityForm>, 2> enum_names(AffinityForm /*type*/) {
    return {{{AffinityForm::links, "links"}, {AffinityForm::formula_8, "formula-8"}}};
}

/// S_ij = 1/2 (||w_ij||_2 + ||w_ji||_2), where w_ij holds the H coefficients of a pair. One exchange of
/// entries gives the transpose. Collective. Source: the paper, equation (8).
SparseRows symmetric_affinity(const Comm& comm, const SparseCoefficients& coefficients);

/// C = B + B^T with B_ij = ||w_ij||_2 / sum_i ||w_ij||_2. The patches that reconstruct a patch thus have the
/// same total weight for every patch. Collective. Deviates: this is not in the paper. A column is the patch
/// that chooses its matches, so that columns are normalised.
SparseRows normalized_links(const Comm& comm, const SparseCoefficients& coefficients);

/// S_ij <- S_ij (1 - mc) for patches i, j with a common boundary. `neighbors` are as gather_patch_pairs gives
/// them. Entries that do not exist stay so. Source: the paper, the minima rule.
void apply_minima_rule(SparseRows& affinity, const std::vector<GlobalPatchNeighbors>& neighbors);

/// A_ij = boundary length (1 - mc)^5, where each mesh is scaled to a total of 1; rows `range`. `mesh_of`: the
/// mesh of each patch. Deviates: this is not in the paper, whose minima rule only weakens entries that exist.
/// The larger the exponent, the less of A lies across creases.
SparseRows adjacency_affinity(BlockRange range, const std::vector<GlobalPatchNeighbors>& neighbors,
                              const std::vector<int>& mesh_of);

/// O_ij is the intersection over union of two patches of different over-segmentations; rows `range` of a
/// matrix of `size`. Deviates: the paper has one over-segmentation for each mesh.
SparseRows overlap_affinity(BlockRange range, const std::vector<GlobalPatchOverlap>& overlaps,
                            std::int64_t size);

}  // namespace coseg
