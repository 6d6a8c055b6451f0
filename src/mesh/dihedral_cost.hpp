#pragma once
// How much a boundary along a mesh edge costs, by the bend of the surface there.

#include <algorithm>
#include <numbers>

#include "src/mesh/dual_graph.hpp"

namespace coseg {

/// clip((theta / pi)^10, 1e-4, 1), where theta is the dihedral angle outside the solid. The cost is 1 on flat
/// and convex edges and falls steeply in concave ones, so that cheap boundaries run along creases (minima
/// rule). The lower bound keeps the graph connected. Virtual edges have theta = pi by definition and so cost
/// 1 per unit of their (short) length.
inline double dihedral_cost(const DualEdge& edge) {
    const double ratio = edge.dihedral / std::numbers::pi;
    const double square = ratio * ratio;
    const double fourth = square * square;
    return std::clamp(fourth * fourth * square, 1e-4, 1.0);
}

}  // namespace coseg
