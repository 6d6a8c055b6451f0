#pragma once
// Any set of triangles made an oriented manifold by copying vertices, never by dropping triangles.

#include <Eigen/Core>
#include <vector>

namespace coseg {

struct ManifoldCut {
    std::vector<Eigen::Vector3i>
        triangles;                   ///< one per given triangle, in the same order, over new vertex numbers
    std::vector<int> source_vertex;  ///< per new vertex: the given vertex it is or copies
    int crowded_edges = 0;           ///< edges that had three or more triangles
    int unorientable_edges = 0;      ///< edges cut because no orientation of both sides fits (Moebius)
    int copied_vertices = 0;
    int flipped_triangles = 0;
};

/// Afterwards every edge has at most two triangles, in opposite directions, and the triangles of every vertex
/// form one fan. Given vertices keep their order; those without a triangle are left out, copies come last.
///
/// - An edge with two triangles joins them, unless they have the same three vertices (twins are kept apart,
/// so that
///   an edge is known by its end points also after refinement). Around one with more, triangles sorted by
///   angle are joined where they bound the same solid wedge (back to front); the rest is cut there.
/// - Orientation: components take one orientation by flood fill; a closed component the one with positive
///   signed volume, an open or flat one that which flips the lesser area.
/// - A vertex whose triangles form several fans gets a copy for each further fan.
/// No triangle repeats a vertex.
ManifoldCut cut_to_manifold(const std::vector<Eigen::Vector3i>& triangles,
                            const std::vector<Eigen::Vector3d>& positions);

}  // namespace coseg
