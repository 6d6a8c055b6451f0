#pragma once
// Reads and writes STL files.

#include <string>
#include <string_view>

#include "io/mesh_files/face_arrays.hpp"
#include "io/mesh_files/parsed_mesh.hpp"
#include "src/mesh/polygon_mesh.hpp"

namespace coseg {

/// Reads ASCII and binary STL. Corners at equal positions become one vertex. Vertices are numbered in the
/// order in which the facets name them; those that only facets with two equal corners name come last.
/// Coordinates of an ASCII file keep all their digits. Its words may be in either case and on any line, "end"
/// may stand apart, names may be glued to "solid" and "endsolid", and a lacking "endsolid" is warned of. The
/// number of facets in the header of a binary file is not believed if it is 0 or 2^32 - 1. What follows the
/// last facet is left out with a warning, and coordinates that have lost digits are warned of
/// (lost_digits.hpp). mesh_format.hpp says what all readers have in common.
ParsedMesh read_stl(std::string_view bytes, const std::string& path);

/// Writes binary STL: triangles in single precision with their normals, without labels, of which STL holds
/// none. Where single precision would lose digits that the edges need (lost_digits.hpp), it is ASCII STL with
/// all digits. Polygons are cut into triangles, and faces of fewer than three corners are left out.
/// Error(output) as atomic_file.hpp, Error(internal) as parts_of.
void write_stl(const std::string& path, const PolygonMesh& mesh, const FaceArrays& arrays);

}  // namespace coseg
