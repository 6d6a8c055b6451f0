#pragma once
// Chooses one part per face from several over-segmentations whose patches have been given parts.

#include <vector>

#include "src/mesh/dual_graph.hpp"
#include "src/mesh/face_geometry.hpp"

namespace coseg {

/// For each face the part that most over-segmentations give it. oversegmentations[o][f] is the patch of face
/// f, and part_of_patch[o][patch] is its part in 0 .. parts-1.
/// A face whose most frequent parts are tied waits for its neighbourhood. In each round, every waiting face
/// that shares an edge with decided faces of one of its tied parts takes the tied part with the largest
/// shared edge length, and of equal lengths the lowest part. A face that no round reaches, for example in a
/// component where all faces are tied, takes its lowest tied part. All faces of a round decide at once, so
/// that the order of faces does not matter. Throws Error(internal) if a patch's part is missing or outside
/// 0 .. parts-1.
std::vector<int> vote_face_labels(const std::vector<std::vector<int>>& oversegmentations,
                                  const std::vector<std::vector<int>>& part_of_patch, int parts,
                                  const DualGraph& graph);

}  // namespace coseg
