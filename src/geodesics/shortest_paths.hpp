#pragma once
// Finds shortest paths in a surface graph, from one source or from sixteen at once.
//
// Both functions give the same bits. Adding a length in floating point is monotone, so that the distances
// are the unique largest solution of d(v) = min over arcs of d(u) + length, whatever the order of the
// updates.

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "src/geodesics/surface_graph.hpp"

namespace coseg {

/// A node, and its distance from the point where the paths start. That point need not be a node itself.
struct PathSource {
    int node = 0;
    float distance = 0.0F;
};

/// Lowers `distance` (one value a node, infinity where nothing is known) to min(distance, distance from the
/// sources). Nodes that do not come closer are not entered, so that another source costs only the
/// neighbourhood that it is nearest to. Returns the nodes that came closer, nearest first (Dijkstra 1959).
std::vector<int> lower_distances(const SurfaceGraph& graph, std::span<const PathSource> sources,
                                 std::vector<float>& distance);

inline constexpr int path_lanes = 16;
using PathLanes = Eigen::Array<float, path_lanes, 1>;

/// Distances of every node from path_lanes starting points. sources[l] belong to lane l; an empty list leaves
/// its lane at infinity. Every node is relaxed for all lanes at once, in sweeps along `order` from the far
/// end to the near one and back, until nothing changes or single searches would be faster. `order` lists all
/// nodes that can be reached, by their distance from a point near the starting points. Few sweeps are needed
/// where the starting points lie close together. The result does not depend on `order`.
void path_distances(const SurfaceGraph& graph, std::span<const std::vector<PathSource>, path_lanes> sources,
                    std::span<const int> order, std::vector<PathLanes>& distance);

}  // namespace coseg
