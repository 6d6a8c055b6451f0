#pragma once
// Replaces a mesh by even triangles and keeps the map back to the faces of its file.

#include "src/mesh/face_map.hpp"
#include "src/mesh/tri_mesh.hpp"

namespace coseg {

/// Remeshes isotropically (src/remesh/isotropic_remesh.hpp) to about `faces` triangles. Edges that turn
/// by more than 30 degrees stay where they are. Every new triangle belongs to the input face of the old
/// triangle under its centroid. An input face under which no new triangle comes to lie takes the label of
/// the nearest new triangle (FaceMap::nearest_working). Deterministic; the topology does not change. mesh
/// is manifold and oriented, and map belongs to it.
///
/// There are at most 5 `faces` new triangles. Small ones on thin limbs and rims make up to 2.7 `faces` on
/// the shapes we know. While edges are split, there are at most 96,000 or 8 `faces`, whichever is more:
/// 25 times 3,000 are needed by one of 600 coarse vases, and 5.6 `faces` by fine shapes. A mesh that
/// needs more, such as a rod that is thousands of times longer than thick, is left as it is. Throws
/// Error(input) then, and if the mesh is not manifold or has no area.
void remesh_evenly(TriMesh& mesh, FaceMap& map, int faces);

}  // namespace coseg
