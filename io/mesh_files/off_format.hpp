#pragma once
// Reads and writes OFF files.

#include <string>
#include <string_view>

#include "src/mesh/polygon_mesh.hpp"
#include "src/mesh/tri_mesh.hpp"

namespace coseg {

/// Reads ASCII OFF, also its variants with ST, C or N in front, with the counts on the keyword's line, and
/// with comments. What follows the coordinates of a vertex or the corners of a face on its line (colours,
/// normals, texture) is passed over. mesh_format.hpp says what all readers have in common.
PolygonMesh read_off(std::string_view bytes, const std::string& path);

/// Coordinates have the fewest digits that read back to the same double. Faces keep their order. The file is
/// written whole or not at all; Error(output) as in atomic_file.hpp.
void write_off(const std::string& path, const PolygonMesh& mesh);
void write_off(const std::string& path, const TriMesh& mesh);

}  // namespace coseg
