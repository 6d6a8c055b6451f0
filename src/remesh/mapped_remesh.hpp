#pragma once
// A mesh replaced by even triangles, with the way back to the faces of its file.

#include "src/mesh/face_map.hpp"
#include "src/mesh/tri_mesh.hpp"

namespace coseg {

/// Remeshes isotropically (src/remesh/isotropic_remesh.hpp) to about `faces` triangles; edges that turn by more than 30
/// degrees stay where they are. Every new triangle belongs to the input face of the old triangle under its centroid;
/// an input face under which none comes to lie takes the label of the new triangle nearest to it
/// (FaceMap::nearest_working). Deterministic; unchanged topology. mesh is manifold and oriented, map is its own.
/// Throws Error(input) if the mesh is not manifold or has no area.
void remesh_evenly(TriMesh& mesh, FaceMap& map, int faces);

}  // namespace coseg
