#pragma once
// The connected regions of equal label.

#include <vector>

#include "src/mesh/dual_graph.hpp"

namespace coseg {

enum class VirtualEdges { connect, ignored };

/// Piece number per face, 0.. by lowest face: two faces are in the same piece if a path of dual edges joins
/// them through faces of their own label.
std::vector<int> connected_pieces(const DualGraph& graph, const std::vector<int>& label_of_face,
                                  VirtualEdges virtual_edges = VirtualEdges::connect);

/// The connected pieces of the common refinement of several labellings: faces of one piece agree in all of
/// them.
std::vector<int> intersection_pieces(const DualGraph& graph, const std::vector<std::vector<int>>& labellings);

}  // namespace coseg
