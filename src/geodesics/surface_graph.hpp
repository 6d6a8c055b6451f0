#pragma once
// The graph whose shortest paths approximate geodesics: its arcs are mesh edges and shortcuts across unfolded
// faces.

#include <vector>

#include "src/mesh/dual_graph.hpp"
#include "src/mesh/tri_mesh.hpp"

namespace coseg {

struct SurfaceArc {
    int node = 0;
    float length = 0.0F;  ///< in the mesh's unit, finite, >= 0
};

/// Nodes 0 .. V-1 are the mesh's vertices. After them comes one node for the centroid of each face that ends
/// a virtual dual edge. Every arc is stored in both directions.
struct SurfaceGraph {
    int vertex_count = 0;
    std::vector<int> offsets;      ///< nodes + 1: the arcs of node v are arcs[offsets[v] .. offsets[v+1])
    std::vector<SurfaceArc> arcs;  ///< ascending by node within a node, none twice

    [[nodiscard]] int node_count() const noexcept { return static_cast<int>(offsets.size()) - 1; }
};

/// Three kinds of arcs: the mesh's edges; for every interior edge the straight line between its two opposite
/// vertices, provided that the two faces, unfolded into one plane, let the line cross that edge; for every
/// virtual dual edge the line between the two centroids (Euclidean length), each centroid being tied to the
/// three vertices of its face. A path in the graph is a path on the unfolded surface. Its length is therefore
/// never below the geodesic distance, and it is at most 3.5 % above it on an evenly triangulated plane (12
/// directions) and 8 % on a grid of right triangles.
SurfaceGraph surface_graph(const TriMesh& mesh, const DualGraph& graph);

}  // namespace coseg
