#pragma once
// What OpenMesh's readers deliver, as polygons: no half-edge structure that would refuse or reorder faces.

#include <string>

#include "io/mesh_files/mesh_check.hpp"
#include "src/mesh/polygon_mesh.hpp"

namespace coseg {

/// Reads the checked mesh's plain form with OpenMesh. Vertices come from OpenMesh (rounded to float) unless
/// the check kept them; faces that OpenMesh leaves out are put back in their places. Throws Error(internal)
/// if OpenMesh delivers other numbers of vertices or faces than were checked.
PolygonMesh import_polygons(CheckedMesh checked, const std::string& path);

}  // namespace coseg
