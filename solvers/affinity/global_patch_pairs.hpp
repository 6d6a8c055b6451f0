#pragma once
// The pairs of patches of one mesh that touch or overlap, with global patch numbers: by mesh in the
// collection's order, then by over-segmentation, then by patch.

#include <tuple>
#include <vector>

#include "src/parallel/comm.hpp"
#include "src/records/fields.hpp"

namespace coseg {

/// Two patches of the same over-segmentation with a common boundary.
struct GlobalPatchNeighbors {
    int patch_a = 0;
    int patch_b = 0;
    double boundary_length = 0.0;  ///< of a mesh of unit area
    double concavity = 0.0;        ///< mc in [0, 1]: mean normalised minimum curvature along the boundary
    static constexpr auto fields() {
        return std::tuple(field("patch_a", &GlobalPatchNeighbors::patch_a),
                          field("patch_b", &GlobalPatchNeighbors::patch_b),
                          field("boundary_length", &GlobalPatchNeighbors::boundary_length),
                          field("concavity", &GlobalPatchNeighbors::concavity));
    }
};

/// Two patches of one mesh in different over-segmentations that share faces.
struct GlobalPatchOverlap {
    int patch_a = 0;
    int patch_b = 0;
    double intersection_over_union = 0.0;  ///< of their areas, in (0, 1]
    static constexpr auto fields() {
        return std::tuple(field("patch_a", &GlobalPatchOverlap::patch_a),
                          field("patch_b", &GlobalPatchOverlap::patch_b),
                          field("intersection_over_union", &GlobalPatchOverlap::intersection_over_union));
    }
};

/// Gives all pairs to all ranks, with patch_a < patch_b, in ascending order whichever rank they come from.
/// Collective. Throws AgreedError(internal) where a patch number is not in 0 .. patches-1 or a pair is given
/// twice.
std::vector<GlobalPatchNeighbors> gather_patch_pairs(const Comm& comm,
                                                     const std::vector<GlobalPatchNeighbors>& local,
                                                     int patches);
std::vector<GlobalPatchOverlap> gather_patch_pairs(const Comm& comm,
                                                   const std::vector<GlobalPatchOverlap>& local, int patches);

/// How many meshes there are, from the mesh of each patch: 0 .. M-1.
int mesh_count(const std::vector<int>& mesh_of);

/// A neighbour of a patch.
struct WeightedNeighbor {
    int patch = 0;
    double weight =
        0.0;  ///< length of the common boundary; the weights of a patch's neighbours sum to 1, or to 0
};

/// Of each of `patches` patches, in the order of the pairs. pairs: of all meshes.
std::vector<std::vector<WeightedNeighbor>> weighted_neighbors(const std::vector<GlobalPatchNeighbors>& pairs,
                                                              int patches);

}  // namespace coseg
