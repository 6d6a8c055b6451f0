#pragma once
// Reads meshes out of files.

#include <string>
#include <string_view>

#include "src/mesh/polygon_mesh.hpp"

namespace coseg {

/// The polygons of the file at `path`, in the file's order: as many faces as the file has, each with its
/// corners (a face that repeats a vertex, or has fewer than three corners, included). The suffix decides the
/// format, in either case: a row of mesh_format.hpp. Colours, normals and texture are ignored. Coordinates
/// are the file's own doubles, those of STL in single precision. Throws Error(input), one sentence naming
/// file and line, face or vertex, for what the formats refuse, for a file that cannot be opened or read,
/// another suffix, and a mesh that has no face or no area. Takes no memory for more than the file really
/// holds.
PolygonMesh read_mesh(const std::string& path);

/// The same for a file's bytes that are in memory already; `path` gives the format and stands in messages.
PolygonMesh parse_mesh(std::string_view bytes, const std::string& path);

/// True for the paths that read_mesh takes.
bool has_mesh_extension(const std::string& path);

}  // namespace coseg
