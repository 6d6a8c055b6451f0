#pragma once
// Meshes into ASCII OFF files.

#include <string>

#include "src/mesh/polygon_mesh.hpp"
#include "src/mesh/tri_mesh.hpp"

namespace coseg {

/// Coordinates in the fewest digits that read back to the same double; faces in their order.
/// Written whole or not at all; Error(output) as in atomic_file.hpp.
void write_off(const std::string& path, const PolygonMesh& mesh);
void write_off(const std::string& path, const TriMesh& mesh);

}  // namespace coseg
