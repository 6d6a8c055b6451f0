#pragma once
// One part per face from several over-segmentations whose patches have been given parts.

#include <vector>

#include "src/mesh/dual_graph.hpp"
#include "src/mesh/face_geometry.hpp"

namespace coseg {

/// The part per face that most over-segmentations give it. oversegmentations[o][f] is the patch of face f,
/// part_of_patch[o][patch] its part in 0..parts-1.
/// A face whose most frequent parts tie waits for its neighbourhood: in rounds, every waiting face that
/// shares an edge with decided faces of one of its tied parts takes the tied part with the largest shared
/// edge length (ties: the lowest part). What no round reaches, e.g. a whole component of ties, takes its
/// lowest tied part. All faces of a round decide at once, so the order of faces does not matter. Throws
/// Error(internal) if a patch's part is missing or outside 0..parts-1.
std::vector<int> vote_face_labels(const std::vector<std::vector<int>>& oversegmentations,
                                  const std::vector<std::vector<int>>& part_of_patch, int parts,
                                  const DualGraph& graph);

}  // namespace coseg
