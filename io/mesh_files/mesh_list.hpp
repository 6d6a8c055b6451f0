#pragma once
// Finds the meshes that a command line names.

#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "src/mesh/polygon_mesh.hpp"
#include "src/records/fields.hpp"

namespace coseg {

struct MeshEntry {
    std::string name;  ///< the file's name without folder and extension; unique in a collection
    std::string path;
    std::uintmax_t bytes = 0;  ///< the file's size; 0 if it is no file, or not to be seen
    /// The mesh itself where it is no file but a caller's arrays. `path` is then what messages call it.
    const PolygonView* polygons = nullptr;
    static constexpr auto fields() {
        return std::tuple(field("name", &MeshEntry::name), field("path", &MeshEntry::path),
                          field("bytes", &MeshEntry::bytes), local(&MeshEntry::polygons));
    }
};

/// Expands MESH | DIRECTORY | @LIST ... into meshes sorted by name (byte order).
/// - A directory means all that is named .off, .obj, .ply, .stl, .glb or .gltf in it (in either case), but
///   not what is hidden (.NAME). An entry that is no file there, such as a folder, a pipe or a link that
///   leads nowhere, is listed as well, so that reading it says why it cannot be used. It gives way to a file
///   of its name.
/// - @LIST is a text file or a pipe with one mesh or directory a line, in UTF-8 or UTF-16, relative to the
///   list's own folder, else to the current one. Blank lines are skipped, and so is everything from a # at
///   the start of a line or after a blank.
/// Throws Error(input) naming the path (and line of the list) if nothing is given, a path that is named
/// itself is missing, a directory or list is unreadable or has no meshes, an extension is unknown, or two
/// files have one name (both are named). Time is linear in the number of files, except for the sorting.
std::vector<MeshEntry> expand_mesh_list(const std::vector<std::string>& arguments);

}  // namespace coseg
