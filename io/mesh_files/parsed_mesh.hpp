#pragma once
// What a reader makes of the bytes of a mesh file.

#include <string>
#include <vector>

#include "src/mesh/polygon_mesh.hpp"

namespace coseg {

struct ParsedMesh {
    PolygonMesh mesh;
    /// What the file holds beside its mesh, or does not say well: one sentence each, beginning with the path.
    std::vector<std::string> warnings;
};

}  // namespace coseg
