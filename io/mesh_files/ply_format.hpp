#pragma once
// Reads PLY files, and writes labelled meshes as coloured PLY files for mesh viewers.

#include <string>
#include <string_view>
#include <vector>

#include "io/mesh_files/face_arrays.hpp"
#include "io/mesh_files/parsed_mesh.hpp"
#include "src/mesh/polygon_mesh.hpp"

namespace coseg {

/// Reads ASCII and binary PLY in either byte order, with numbers of any kind: x, y and z of the elements
/// "vertex", and one list "vertex_indices" or "vertex_index" of the elements "face" and "tristrips". A strip
/// gives its triangles, except those that repeat a corner. All other properties and elements are passed over,
/// whatever their words. mesh_format.hpp says what all readers have in common.
ParsedMesh read_ply(std::string_view bytes, const std::string& path);

/// Writes the polygons as binary little-endian PLY: vertices as float (viewers expect it), or as double
/// where float would lose digits that the edges need (lost_digits.hpp), faces in their order with the
/// colour of their part (part_colors.hpp) as uchar red, green, blue. labels has one entry per face. Written
/// whole or not at all; Error(output) as in atomic_file.hpp, Error(internal) if the counts differ.
/// `confidence` is empty, or one number a face, which becomes its float property "confidence".
void write_colored_ply(const std::string& path, const PolygonMesh& mesh, const std::vector<int>& labels,
                       const std::vector<float>& confidence = {});

/// The same for the parts among the arrays.
void write_ply(const std::string& path, const PolygonMesh& mesh, const FaceArrays& arrays);

}  // namespace coseg
