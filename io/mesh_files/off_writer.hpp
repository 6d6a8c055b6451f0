#pragma once
// Writes meshes as ASCII OFF files.

#include <string>

#include "src/mesh/polygon_mesh.hpp"
#include "src/mesh/tri_mesh.hpp"

namespace coseg {

/// Coordinates have the fewest digits that read back to the same double. Faces keep their order. The file is
/// written whole or not at all; Error(output) as in atomic_file.hpp.
void write_off(const std::string& path, const PolygonMesh& mesh);
void write_off(const std::string& path, const TriMesh& mesh);

}  // namespace coseg
