#pragma once
// Finds borders that run along each other, edge by edge, without being joined.

#include <Eigen/Core>
#include <vector>

#include "src/mesh/polygon_mesh.hpp"

namespace coseg {

/// An edge that one face alone has, in that face's direction, over stand-ins of vertices.
struct BorderEdge {
    int from = 0;
    int to = 0;
    int face = 0;
    /// Unit vector in the face's plane, across the edge and into the face; 0 for a face without area.
    Eigen::Vector3d inward = Eigen::Vector3d::Zero();
};

/// vertex_of: per vertex the one that stands for it. Edges are ordered by their vertices.
std::vector<BorderEdge> border_edges(const PolygonMesh& mesh, const std::vector<int>& vertex_of);

/// What counts as near. Both limits hold.
struct BorderLimits {
    double of_size = 1e-5;  ///< share of the diagonal of the bounding box; 0: nothing is near
    double of_edge = 1e-3;  ///< share of the shortest border edge at either vertex
    /// The surface must go on from one border to the other: two edges may then run either way, but they share
    /// no vertex, and their faces do not lie upon each other as the two skins of a thin plate do. Without it
    /// two edges only have to run in opposite directions.
    bool must_continue = false;
};

/// Two border edges whose ends are near each other.
struct BorderMatch {
    int edge = 0;  ///< numbers among the edges
    int other = 0;
    int other_at_from = 0;  ///< the vertex of the other edge that is near the first one's `from`
    int other_at_to = 0;
    double distance = 0.0;  ///< of the ends, the larger
};

/// For each edge that matches exactly one other edge, that match. Where more than 16 border vertices lie
/// within the limit, they match nothing. Time: O(n log n).
std::vector<BorderMatch> match_borders(const PolygonMesh& mesh, const std::vector<BorderEdge>& edges,
                                       const BorderLimits& limits);

/// Of the bounding box of all vertices that faces use; 0 without a face.
double used_diagonal(const PolygonMesh& mesh);

}  // namespace coseg
