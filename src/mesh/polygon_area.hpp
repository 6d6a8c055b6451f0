#pragma once
// Areas of the faces of a mesh as it stands in its file.

#include <vector>

#include "src/mesh/polygon_mesh.hpp"

namespace coseg {

/// The area of every face, in the square of the file's unit. It is the sum over the fan of triangles from the
/// face's first corner: exact for convex planar polygons, and 0 for a face of fewer than three corners. Of
/// meshes below 1e-150 they are below what doubles hold.
std::vector<double> polygon_areas(const PolygonMesh& mesh);

/// The same in a unit of the mesh's own, which is the file's but for extreme meshes (moderate_scale.hpp): for
/// shares of the area of a mesh, which are right at any size.
std::vector<double> relative_areas(const PolygonMesh& mesh);

}  // namespace coseg
