#pragma once
// Finds the connected regions of equal label.

#include <vector>

#include "src/mesh/dual_graph.hpp"

namespace coseg {

enum class VirtualEdges { connect, ignored };

/// The number of the piece of each face. Two faces are in the same piece if a path of dual edges joins them
/// through faces of their own label. Pieces are numbered from 0 in the order of their lowest face.
std::vector<int> connected_pieces(const DualGraph& graph, const std::vector<int>& label_of_face,
                                  VirtualEdges virtual_edges = VirtualEdges::connect);

}  // namespace coseg
