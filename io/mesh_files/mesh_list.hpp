#pragma once
// The meshes that a command line names.

#include <cstdint>
#include <string>
#include <vector>

namespace coseg {

struct MeshEntry {
    std::string name;  ///< the file's name without folder and extension; unique in a collection
    std::string path;
    std::uintmax_t bytes = 0;  ///< the file's size
};

/// Expands MESH | DIRECTORY | @LIST ... into meshes sorted by name (byte order).
/// - A directory stands for the .off, .obj, .ply and .stl files in it (either case), not for folders in it
///   nor for hidden files (.NAME).
/// - @LIST is a text file with one mesh or directory a line, relative to the list's own folder, else to the
///   current one; blank lines and what follows a # at the start of a line or behind a blank are left out.
/// Throws Error(input) naming the path (and line of the list) for: nothing given, a path that is missing or
/// unreadable, a directory or list without meshes, an unknown extension, two files of one name (both are
/// named). Time grows with the number of files, but for the sorting.
std::vector<MeshEntry> expand_mesh_list(const std::vector<std::string>& arguments);

}  // namespace coseg
