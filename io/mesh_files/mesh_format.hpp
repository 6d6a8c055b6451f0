#pragma once
// The mesh formats that coseg knows, one row each: nothing else in the program knows their names or suffixes.

#include <span>
#include <string>
#include <string_view>

#include "src/mesh/polygon_mesh.hpp"

namespace coseg {

struct MeshFormat {
    std::string_view name;    ///< in help and messages: "OFF"
    std::string_view suffix;  ///< of its files, with the dot, in lower case: ".off"

    /// The polygons of a file's bytes, in the file's order: as many faces as the file has, each with its
    /// corners (a face that repeats a vertex, or has fewer than three corners, included). Throws
    /// Error(input), one sentence that begins with "PATH:LINE: " (text) or "PATH: " and names face or vertex,
    /// for a file that cannot be parsed, is cut short, holds fewer items than it promises, an index that is
    /// no vertex, or what mesh_limits.hpp refuses. Takes memory as items are found, or for as many as the
    /// file has room for, never for what a header merely promises. A mesh without faces is no error here.
    PolygonMesh (*read)(std::string_view bytes, const std::string& path);
};

/// All rows, in the order in which help and messages name them.
std::span<const MeshFormat> mesh_formats();

/// What stands behind the last dot of the file's name, in lower case, with the dot; empty if there is no dot.
std::string suffix_of(const std::string& path);

/// The row of the path's suffix; nullptr if there is none.
const MeshFormat* mesh_format_of(const std::string& path);

/// "OFF, OBJ, PLY, STL".
std::string readable_formats();

/// ".off, .obj, .ply WORD .stl".
std::string readable_suffixes(std::string_view word);

}  // namespace coseg
