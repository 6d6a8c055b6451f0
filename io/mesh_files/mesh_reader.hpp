#pragma once
// Meshes out of OFF, OBJ, PLY and STL files, through OpenMesh.

#include <string>
#include <string_view>

#include "src/mesh/polygon_mesh.hpp"

namespace coseg {

/// The polygons of the file at `path`, in the file's order: as many faces as the file has, each with its
/// corners (a face that repeats a vertex, or has fewer than three corners, included). The extension decides
/// the format, in either case: .off (ASCII, also ST, C, N variants), .obj, .ply (ASCII and binary), .stl
/// (ASCII and binary; equal positions become one vertex). Colours, normals and texture are ignored.
/// Coordinates are the file's own doubles. Throws Error(input), one sentence naming file and line, face or
/// vertex, if the file cannot be opened or parsed, is cut short, holds fewer items than it promises, an index
/// that is no vertex, a coordinate that is not finite or beyond 1e37, no face, or no area. Never takes memory
/// for more than the file really holds.
PolygonMesh read_mesh(const std::string& path);

/// The same for a file's bytes that are in memory already; `path` gives the format and stands in messages.
PolygonMesh parse_mesh(std::string_view bytes, const std::string& path);

/// True for the paths that read_mesh takes: "off", "obj", "ply" or "stl" behind the last dot, in either case.
bool has_mesh_extension(const std::string& path);

}  // namespace coseg
