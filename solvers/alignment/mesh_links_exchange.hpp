#pragma once
// Brings the links of every mesh to the rank that aligns it.

#include <cstdint>
#include <span>
#include <vector>

#include "solvers/subspace/coefficients.hpp"
#include "src/parallel/block_range.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

/// A patch of one mesh and a patch of another by which it is reconstructed, or which it reconstructs.
struct PatchLink {
    int own = 0;  ///< number of the patch in the collection, like the next one
    int other = 0;
    double weight = 0.0;
};

/// The links of this rank's meshes to some of the others.
struct LinksOfMeshes {
    BlockRange meshes;                          ///< block_range(meshes, ranks, rank)
    std::vector<std::vector<PatchLink>> links;  ///< one list for each, ascending by own and other
};

struct LinkRequest {
    const SparseCoefficients& coefficients;
    const std::vector<int>& mesh_of;           ///< of all patches, ascending
    const std::vector<double>& patch_area;     ///< of all patches
    std::span<const std::uint64_t> mesh_keys;  ///< one for each mesh, a hash of its name
    int most_partners = 10;                    ///< other meshes to which links are kept
};

/// The weight of a link i - j is ||w_ij||_2 / sum_i ||w_ij||_2 times the area of j, in either direction. Of
/// the meshes that a mesh has links to, those are kept that come first in an order which is a hash of both
/// keys. A rank holds the links of its own meshes alone. There may be at most 2^30 of them in all. The result
/// is the same on any number of ranks. Collective.
LinksOfMeshes links_of_meshes(const Comm& comm, const LinkRequest& request);

}  // namespace coseg
