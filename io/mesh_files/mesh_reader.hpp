#pragma once
// Reads meshes out of files.

#include <string>
#include <string_view>

#include "io/mesh_files/parsed_mesh.hpp"
#include "src/mesh/polygon_mesh.hpp"

namespace coseg {

/// The bytes of the mesh file at `path`, together with those of files that it needs (the buffers of a .gltf
/// file). Throws Error(input) for another suffix and for a file that cannot be opened or read.
std::string mesh_file_bytes(const std::string& path);

/// The polygons of a file's bytes, in the file's order: as many faces as the file has, each with its corners
/// (a face that repeats a vertex, or has fewer than three corners or none, included). The suffix of `path`
/// decides the format, in either case: a row of mesh_format.hpp. Text may be in UTF-8 or UTF-16. Colours,
/// normals and texture are ignored. Coordinates are the file's own doubles. Throws Error(input), one sentence
/// naming file and line, face or vertex, for what the formats refuse, another suffix, and a mesh that has no
/// face or no area. Where the file is something else than its suffix says, the sentence says what it is
/// (foreign_content.hpp). Takes no memory for more than the file really holds.
ParsedMesh parse_mesh(std::string_view bytes, const std::string& path);

/// The same of polygons in memory, which messages call `name`: faces and vertices are counted from 0. Throws
/// Error(input) where the arrays do not fit together, a face refers to no vertex or uses one whose
/// coordinates are not usable, and for a mesh that has no face or no area.
ParsedMesh checked_polygons(const PolygonView& polygons, const std::string& name);

/// The mesh of the file at `path`, without what parse_mesh warns of: it is for meshes that a run or
/// `coseg check` has spoken of. Throws Error(input) also for a file that
/// cannot be opened or read.
PolygonMesh read_mesh(const std::string& path);

/// True for the paths that read_mesh takes.
bool has_mesh_extension(const std::string& path);

}  // namespace coseg
