#pragma once
// The mesh formats that coseg knows, one row each: nothing else in the program knows their names or suffixes.

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/mesh_files/face_arrays.hpp"
#include "io/mesh_files/parsed_mesh.hpp"
#include "src/mesh/polygon_mesh.hpp"

namespace coseg {

struct MeshFormat {
    std::string_view name;    ///< in help and messages: "OFF"
    std::string_view suffix;  ///< of its files, with the dot, in lower case: ".off"

    /// The polygons of a file's bytes, in the file's order: as many faces as the file has, each with its
    /// corners (a face that repeats a vertex, or has fewer than three corners or none, included). Vertices
    /// that no face uses and whose coordinates are no usable numbers are left out with a warning. Throws
    /// Error(input), one sentence that begins with "PATH:LINE: " (text) or "PATH: " and names face or vertex,
    /// for a file that cannot be parsed, is cut short, holds fewer items than it promises, an index that is
    /// no vertex, or what mesh_limits.hpp refuses. Takes memory as items are found, or for as many as the
    /// file has room for, never for what a header merely promises. A mesh without faces is no error here.
    /// nullptr for a format that is only written.
    ParsedMesh (*read)(std::string_view bytes, const std::string& path) = nullptr;

    /// Writes the polygons with their parts, and with as much of the other arrays as the format holds. The
    /// file is written whole or not at all; Error(output) as in atomic_file.hpp, Error(internal) if there is
    /// no array of parts, or an array has not one value per face. nullptr for a format that is only read.
    void (*write)(const std::string& path, const PolygonMesh& mesh, const FaceArrays& arrays) = nullptr;

    /// What `coseg export --to` calls it; empty for its name in lower case.
    std::string_view export_name = {};

    /// Makes one string of the bytes of the file at `path` and of the files that it refers to and needs,
    /// which `read` then takes. Throws Error(input). nullptr if a file of the format stands alone.
    std::string (*gather)(std::string bytes, const std::string& path) = nullptr;

    /// Writes the file `source`, from which `read` makes the mesh, again with its parts, and with all else
    /// that it holds. Throws as `write` and `read`. nullptr if the format holds no more than `write` writes.
    void (*write_like)(const std::string& path, const MeshSource& source, const FaceArrays& arrays) = nullptr;

    /// Whether `write` keeps arrays.values, which are costly to find.
    bool keeps_values = false;

    /// Writes into `folder` what all files of the format refer to, for parts 0 .. parts - 1. nullptr if there
    /// is nothing of the kind.
    void (*write_shared)(const std::string& folder, int parts) = nullptr;

    /// Writes at `path`, whose suffix is collection_suffix, a file that opens many at once: (name, path of
    /// the file relative to this one). nullptr if the format has none.
    void (*write_collection)(const std::string& path,
                             const std::vector<std::pair<std::string, std::string>>& files) = nullptr;
    std::string_view collection_suffix = {};
};

/// All rows, in the order in which help and messages name them.
std::span<const MeshFormat> mesh_formats();

/// The suffix of the file's name: its last dot and what follows it, in lower case; empty if there is no dot.
std::string suffix_of(const std::string& path);

/// The row of the path's suffix if it can be read; nullptr otherwise.
const MeshFormat* readable_format_of(const std::string& path);

/// The names of the rows that can be written, in lower case: "off", "obj", "ply".
std::vector<std::string> writable_formats();

/// The row of such a name.
const MeshFormat& writable_format(const std::string& name);

/// "OFF, OBJ, PLY, STL, GLB, glTF, VTK": the rows that can be read.
std::string readable_formats();

/// ".off, .obj, .ply, .stl, .glb, .gltf WORD .vtp".
std::string readable_suffixes(std::string_view word);

}  // namespace coseg
