#pragma once
// Finds which patches of one mesh touch (inside one over-segmentation) and which overlap (between two).

#include <Eigen/Core>
#include <tuple>
#include <vector>

#include "src/mesh/dual_graph.hpp"
#include "src/mesh/face_geometry.hpp"
#include "src/records/fields.hpp"

namespace coseg {

struct PatchNeighbors {
    int patch_a = -1;  ///< patch_a < patch_b, of the same over-segmentation
    int patch_b = -1;
    double boundary_length = 0.0;  ///< > 0 unless every shared edge has no length; unit of the mesh
    double concavity = 0.0;        ///< mc of the paper, in [0, 1]
    static constexpr auto fields() {
        return std::tuple(field("patch_a", &PatchNeighbors::patch_a),
                          field("patch_b", &PatchNeighbors::patch_b),
                          field("boundary_length", &PatchNeighbors::boundary_length),
                          field("concavity", &PatchNeighbors::concavity));
    }
};

struct PatchOverlap {
    int patch_a = -1;                      ///< of the first over-segmentation
    int patch_b = -1;                      ///< of the second
    double intersection_over_union = 0.0;  ///< of areas, in (0, 1]
    static constexpr auto fields() {
        return std::tuple(field("patch_a", &PatchOverlap::patch_a), field("patch_b", &PatchOverlap::patch_b),
                          field("intersection_over_union", &PatchOverlap::intersection_over_union));
    }
};

/// The area of each patch 0 .. count-1; 0 for a patch without faces.
Eigen::VectorXd patch_areas(const FaceGeometry& geometry, const std::vector<int>& patch_of_face, int count);

/// The pairs of patches with a common boundary, ascending by (patch_a, patch_b). boundary_length sums the
/// lengths of the dual edges between them. concavity is the length-weighted mean over these edges of the mean
/// of `vertex_minimum_curvature` (per vertex, [0, 1]: src/descriptors/minimum_curvature.hpp) at the edge's
/// two ends. A virtual edge counts with its (short) fictitious length and concavity 0: it exists to keep
/// separate components together, and a concave one would have no effect in length * (1 - mc)^5. Concavity is
/// 0 where all shared edges have no length.
///
/// Source: Hu, Fan, Liu 2012 (minima rule, mc).
///
/// Deviates: weighted by edge length, so that mc does not depend on how finely the boundary is meshed.
std::vector<PatchNeighbors> patch_neighbors(const DualGraph& graph, const std::vector<int>& patch_of_face,
                                            const Eigen::VectorXd& vertex_minimum_curvature);

/// The pairs with faces of positive area in common, ascending by (patch_a, patch_b). Both over-segmentations
/// are of the faces of `geometry`.
std::vector<PatchOverlap> patch_overlaps(const FaceGeometry& geometry, const std::vector<int>& patches_a,
                                         const std::vector<int>& patches_b);

}  // namespace coseg
