#pragma once
// Cuts a mesh into many small patches, the units that are later clustered into parts.

#include <cstdint>
#include <vector>

#include "src/mesh/dual_graph.hpp"
#include "src/mesh/face_geometry.hpp"

namespace coseg {

struct OversegmentationOptions {
    int patches = 50;  ///< p, >= 1
    /// Standard deviation of the logarithm of the edge weights' noise, >= 0; 0: no randomness.
    double noise = 0.3;
    /// Before the cuts, faces are agglomerated to this number of super-faces (never fewer than `patches`).
    int super_faces = 1500;
};

/// The patch of each face, 0 .. count-1, with count = min(patches, faces). Every patch is non-empty and
/// connected in the dual graph, where virtual edges count. Patches are numbered by their lowest face. With no
/// more faces than patches, each face is a patch. A dual graph in several components (src/mesh/dual_graph.hpp
/// makes none) gives at least one patch for each.
///
/// The weight of an edge is length * dihedral_cost * exp(noise * n). Here n is standard normal and a
/// function of `seed` and of the edge's two vertices only (of its two faces for a virtual edge). Faces are
/// agglomerated to super-faces. Then, again and again, the region whose best cut has the smallest cut / A_1
/// + cut / A_2 is cut in two (solvers/oversegmentation/fiedler_cut.hpp, with areas as masses), and each
/// side is split into its connected pieces, until there are p regions. Where one of them has more than 8
/// times the mean area of a patch, cuts go on until there are p regions of at least a twentieth of the mean
/// area of a patch. Smaller ones are crumbs (teeth, dust, what is left at holes), which are cut off first,
/// as their borders are short. Of surplus regions the smallest in area joins the neighbour with which it
/// shares the most edge weight. At most 10 p cuts are made. The result does not depend on scale; the order
/// of faces matters only where values tie. `geometry` and `graph` are of the same mesh. Throws Error(usage)
/// for options out of range.
///
/// Source: Hu, Fan, Liu 2012 (p = 50 patches a mesh by normalised cuts on the graph of faces).
///
/// Deviates: weights are boundary lengths times a dihedral cost instead of exp(-d / mean d), and the cut
/// is recursive and two-way, because one K-way spectral clustering gives disconnected and empty patches. The
/// noise makes several over-segmentations of one mesh differ where the cut is arbitrary; all of them are used
/// together.
std::vector<int> oversegment(const FaceGeometry& geometry, const DualGraph& graph,
                             const OversegmentationOptions& options, std::uint64_t seed);

}  // namespace coseg
