#pragma once
// Makes an oriented manifold of any set of triangles by copying vertices. No triangle is dropped.

#include <Eigen/Core>
#include <vector>

namespace coseg {

struct ManifoldCut {
    /// One per given triangle, in the same order, over new vertex numbers.
    std::vector<Eigen::Vector3i> triangles;
    std::vector<int> source_vertex;  ///< per new vertex: the given vertex it is or copies
    int crowded_edges = 0;           ///< edges that had three or more triangles
    /// Edges that were cut because no orientation of both sides fits, as in a Moebius strip.
    int unorientable_edges = 0;
    int copied_vertices = 0;
    int flipped_triangles = 0;
};

/// In the result every edge has at most two triangles, in opposite directions, and the triangles of every
/// vertex form one fan. Given vertices keep their order. Those without a triangle are left out, and copies
/// come last.
/// - An edge with two triangles joins them, unless both have the same three vertices. Such twins are kept
///   apart, so that an edge is known by its end points also after refinement.
/// - Around an edge with more than two triangles, these are sorted by angle, and neighbours that bound the
///   same solid wedge, back to front, are joined. The other triangles are cut apart there.
/// - Orientation: each component gets one orientation by flood fill. A component takes the one with positive
///   signed volume, for which borders are closed by cones to their common centre; a flat one takes the one
///   that flips the lesser area.
/// - A vertex whose triangles form several fans gets a copy for each further fan.
/// The given triangles must not repeat a vertex.
ManifoldCut cut_to_manifold(const std::vector<Eigen::Vector3i>& triangles,
                            const std::vector<Eigen::Vector3d>& positions);

}  // namespace coseg
