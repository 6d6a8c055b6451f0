#pragma once
// Reads and writes OFF files.

#include <string>
#include <string_view>

#include "io/mesh_files/face_arrays.hpp"
#include "io/mesh_files/parsed_mesh.hpp"
#include "src/mesh/polygon_mesh.hpp"
#include "src/mesh/tri_mesh.hpp"

namespace coseg {

/// Reads ASCII OFF in all its variants (off_header.hpp), as the free format that it is: numbers may stand
/// on any line, as long as each face begins one or no face has a colour. What follows the coordinates of a
/// vertex or the corners of a face (normals, colours, texture) is passed over. What follows the promised
/// faces is left out with a warning. mesh_format.hpp says what all readers have in common.
ParsedMesh read_off(std::string_view bytes, const std::string& path);

/// Coordinates have the fewest digits that read back to the same double. Faces keep their order. The file is
/// written whole or not at all; Error(output) as in atomic_file.hpp.
void write_off(const std::string& path, const PolygonMesh& mesh);
void write_off(const std::string& path, const TriMesh& mesh);

/// The same without its labels, of which OFF holds none. Error(internal) as parts_of.
void write_labelled_off(const std::string& path, const PolygonMesh& mesh, const FaceArrays& arrays);

}  // namespace coseg
