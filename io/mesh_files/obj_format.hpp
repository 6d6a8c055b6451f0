#pragma once
// Reads Wavefront OBJ files, and writes labelled meshes as OBJ with one material per part.

#include <string>
#include <string_view>

#include "io/mesh_files/face_arrays.hpp"
#include "io/mesh_files/parsed_mesh.hpp"
#include "src/mesh/polygon_mesh.hpp"

namespace coseg {

/// Reads the lines "v" and "f" (or "fo", its older name) and skips all others, so that no material file is
/// opened. Vertices may be numbered backwards from the latest one (-1), and what follows a slash (texture,
/// normal) or the third coordinate (a weight, a colour) is left out. A face of at least three different
/// vertices names each of them once. A backslash at the end of a line, blanks behind it allowed, joins the
/// next line to it. mesh_format.hpp says what all readers have in common.
ParsedMesh read_obj(std::string_view bytes, const std::string& path);

/// Writes FOLDER/parts.mtl: `parts` materials part_0, part_1, ... in the colours of part_colors.hpp.
/// Error(output) as atomic_file.hpp.
void write_obj_materials(const std::string& folder, int parts);

/// Writes vertices in their order with 9 digits, or 17 where lost_digits.hpp asks for them, and the faces
/// of each part, in their order, under its material, which stands in parts.mtl in the same folder.
/// Error(output) as there, Error(internal) as parts_of.
void write_obj(const std::string& path, const PolygonMesh& mesh, const FaceArrays& arrays);

}  // namespace coseg
