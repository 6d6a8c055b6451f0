#pragma once
// The triangles into which the faces of a file are cut.

#include <array>
#include <vector>

#include "src/mesh/polygon_mesh.hpp"

namespace coseg {

struct FaceTriangle {
    int face = 0;
    std::array<int, 3> vertices{};
};

/// The triangles of all faces in the order of the faces, cut as polygon_triangulation.hpp says. Faces of
/// fewer than three corners have none; triangles may have no area.
std::vector<FaceTriangle> face_triangles(const PolygonMesh& mesh);

}  // namespace coseg
