#include "src/remesh/face_suitability.hpp"

#include <algorithm>
#include <cmath>

#include "src/mesh/face_geometry.hpp"

namespace coseg {

double overlong_area_share(const TriMesh& mesh, int patches) {
    const FaceGeometry geometry = face_geometry(mesh);
    if (!(geometry.total_area > 0.0)) return 0.0;
    const double limit = std::sqrt(geometry.total_area / patches);
    double overlong = 0.0;
    for (int f = 0; f < mesh.face_count(); ++f) {
        const Eigen::Vector3d a = mesh.vertices.col(mesh.faces(0, f));
        const Eigen::Vector3d b = mesh.vertices.col(mesh.faces(1, f));
        const Eigen::Vector3d c = mesh.vertices.col(mesh.faces(2, f));
        const double longest = std::max({(a - b).norm(), (b - c).norm(), (c - a).norm()});
        if (longest > limit) overlong += geometry.area[f];
    }
    return overlong / geometry.total_area;
}

}  // namespace coseg
