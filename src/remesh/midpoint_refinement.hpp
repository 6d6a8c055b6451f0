#pragma once
// Gives more faces to meshes that are too coarse to be cut into patches.

#include "src/mesh/face_map.hpp"
#include "src/mesh/tri_mesh.hpp"

namespace coseg {

/// Splits the longest edge at its midpoint, again and again, until the mesh has at least minimum_faces
/// faces (and at most one more). Both faces at the edge are split, so that the mesh stays as manifold,
/// oriented and closed as it was, and its surface does not move. Triangles become even in size, and their
/// angles stay bounded (Rivara 1984). Edges of equal length are split in the order of their vertex
/// numbers. map.input_face is extended: each half belongs to the input face of the whole. New vertices
/// and faces come last. Nothing changes if the mesh is fine enough or has no faces. Where doubles cannot
/// halve the longest edge any more, for example of a small mesh far from the origin, it ends with fewer
/// faces. Cost: O(n log n) for n faces in the end.
void refine_to_face_count(TriMesh& mesh, FaceMap& map, int minimum_faces);

}  // namespace coseg
