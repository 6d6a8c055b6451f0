#pragma once
// What a reader takes, and what it makes of it.

#include <string>
#include <vector>

#include "src/mesh/polygon_mesh.hpp"

namespace coseg {

/// The file from which a mesh was read.
struct MeshSource {
    std::string path;
    std::string bytes;  ///< those of mesh_file_bytes (mesh_reader.hpp)
};

struct ParsedMesh {
    PolygonMesh mesh;
    /// What the file holds beside its mesh, or does not say well: one sentence each, beginning with the path.
    std::vector<std::string> warnings;
};

}  // namespace coseg
