#pragma once
// Takes some faces out of a mesh.

#include <vector>

#include "src/mesh/polygon_mesh.hpp"

namespace coseg {

/// The faces with these numbers, in this order, with the vertices that they use, in the order of `mesh`.
PolygonMesh selected_faces(const PolygonMesh& mesh, const std::vector<int>& faces);

}  // namespace coseg
