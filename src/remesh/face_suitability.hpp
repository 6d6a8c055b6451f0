#pragma once
// Tells whether a mesh's triangles are small enough to be grouped into patches.

#include "src/mesh/tri_mesh.hpp"

namespace coseg {

/// The share of the area that lies in triangles too long for patches: those with an edge longer than the side
/// of a patch, sqrt(area / patches). Such a triangle, for example a sliver of a drawn solid or the side of a
/// primitive, reaches across patches, and the boundary of a patch cannot cut it. The share is in [0, 1] and
/// independent of scale; it is 0 for a mesh without area. patches >= 1.
double overlong_area_share(const TriMesh& mesh, int patches);

}  // namespace coseg
