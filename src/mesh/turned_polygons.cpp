#include "src/mesh/turned_polygons.hpp"

#include <Eigen/LU>
#include <algorithm>

#include "src/base/index.hpp"

namespace coseg {

PolygonMesh turned(PolygonMesh mesh, const Eigen::Matrix3d& rotation) {
    for (Eigen::Vector3d& vertex : mesh.vertices) vertex = (rotation * vertex).eval();
    if (rotation.determinant() > 0.0) return mesh;
    for (int f = 0; f < mesh.face_count(); ++f)
        std::reverse(mesh.corners.begin() + mesh.offsets[at(f)],
                     mesh.corners.begin() + mesh.offsets[at(f) + 1]);
    return mesh;
}

}  // namespace coseg
