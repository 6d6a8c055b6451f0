#pragma once
// Cuts a weighted graph into two sides by the second eigenvector of its Laplacian.

#include <vector>

#include "solvers/oversegmentation/weighted_graph.hpp"

namespace coseg {

/// Says how the order of nodes was found along which the cut was searched.
enum class CutOrigin {
    components,  ///< the graph was not connected: the component of node 0 against the rest, value 0
    lanczos,     ///< Fiedler vector by Lanczos iterations on the inverse of the Laplacian
    dense,       ///< Fiedler vector by a dense eigen-solve: small graphs, or Lanczos without convergence
    /// Distance from a far node: both eigen-solves failed (weights beyond what doubles can factor).
    breadth_first,
};

struct TwoWayCut {
    std::vector<char> side;      ///< per node 0 or 1; both occur, node 0 is on side 0
    double value = 0.0;          ///< cut / mass_0 + cut / mass_1
    double fiedler_value = 0.0;  ///< second eigenvalue; 0 for components and breadth_first
    CutOrigin origin = CutOrigin::components;
};

/// Second-smallest eigenvalue and its vector of L x = mu M x, L the graph Laplacian, M = diag(mass). x^T M x
/// = 1.
struct FiedlerPair {
    double value = 0.0;
    std::vector<double> vector;  ///< empty if the solve did not succeed
    CutOrigin origin = CutOrigin::lanczos;
};

/// The place of each node in an order of elimination with little fill, the Cholesky factor of whose Laplacian
/// is sparse. So is that of each induced subgraph whose nodes keep this order.
///
/// Source: Amestoy, Davis and Duff 1996 (approximate minimum degree), as Eigen has it.
std::vector<int> elimination_places(const WeightedGraph& graph);

/// The graph must be connected and have at least two nodes. It is fast where nodes are numbered in an order
/// of elimination with little fill. Graphs of more than a few dozen nodes are solved by Lanczos iterations,
/// others densely. Where Lanczos does not converge, the dense solve follows. Where that fails too, `vector`
/// is empty.
FiedlerPair fiedler_pair(const WeightedGraph& graph);

/// The best cut among the prefixes of the nodes sorted by the Fiedler vector: the one with the smallest
/// cut / mass_0 + cut / mass_1. Never fails; at least two nodes. The same graph always gives the same cut.
///
/// Source: Shi and Malik 2000, "Normalized cuts and image segmentation" (eigenvector, best of its splitting
/// points).
///
/// Deviates: masses are given (areas, for faces) and not the nodes' degrees, so that a patch is large in area
/// and not in edge weight.
TwoWayCut fiedler_cut(const WeightedGraph& graph);

}  // namespace coseg
