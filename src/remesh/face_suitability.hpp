#pragma once
// Whether a mesh's triangles are small enough to be grouped into patches.

#include "src/mesh/tri_mesh.hpp"

namespace coseg {

/// The share of the surface that lies in triangles too long for patches: with an edge longer than the side of a
/// patch, sqrt(area / patches). Such a triangle, a sliver of a drawn solid or the side of a primitive, reaches
/// across patches, whose boundaries cannot cut it. In [0, 1], free of scale; 0 for a mesh without area. patches >= 1.
double overlong_area_share(const TriMesh& mesh, int patches);

}  // namespace coseg
