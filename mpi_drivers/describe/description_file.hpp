#pragma once
// Keeps a mesh's description as a file of the state folder, and makes the key that says when it may be used
// again.

#include <string>
#include <string_view>

#include "io/files/content_hash.hpp"
#include "mpi_drivers/describe/mesh_description.hpp"

namespace coseg {

/// A hash of all that a description depends on: the file's bytes, the mesh's name and extension, the options,
/// and the program itself (source_fingerprint.hpp).
ContentHash description_key(std::string_view bytes, const std::string& name, const std::string& path,
                            const DescriptionOptions& options);

/// Writes all of the description except the polygons of the input, which are in the mesh's own file. `path`
/// is that of the mesh's file; it is left out of the warnings. Throws Error(output).
void write_description(const std::string& file, const DescribedMesh& described, const std::string& name,
                       const std::string& path, const DescriptionOptions& options);

/// Reads a description as it was written, with `mesh` and `key` of this collection and without `input`.
/// Throws Error(input) for a file that is damaged or holds something else.
DescribedMesh read_description(const std::string& file, int mesh, const std::string& name,
                               const std::string& path);

inline constexpr const char* description_format = "coseg mesh description";
inline constexpr int description_version = 4;

}  // namespace coseg
