#include "src/mesh/face_geometry.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "src/base/error.hpp"

namespace coseg {

FaceGeometry face_geometry(const TriMesh& mesh) {
    const int faces = mesh.face_count();
    FaceGeometry geometry;
    geometry.area.resize(faces);
    geometry.normal.resize(3, faces);
    geometry.centroid.resize(3, faces);
    for (int f = 0; f < faces; ++f) {
        const Eigen::Vector3d a = mesh.vertices.col(mesh.faces(0, f));
        const Eigen::Vector3d b = mesh.vertices.col(mesh.faces(1, f));
        const Eigen::Vector3d c = mesh.vertices.col(mesh.faces(2, f));
        const Eigen::Vector3d cross = (b - a).cross(c - a);
        const double length = cross.norm();
        geometry.area[f] = 0.5 * length;
        geometry.normal.col(f) = length > 0.0 ? Eigen::Vector3d(cross / length) : Eigen::Vector3d::Zero();
        geometry.centroid.col(f) = (a + b + c) / 3.0;
        geometry.total_area += geometry.area[f];
    }
    return geometry;
}

Eigen::Vector3d surface_centroid(const FaceGeometry& geometry) {
    return geometry.centroid * geometry.area / geometry.total_area;
}

void scale_to_unit_area(TriMesh& mesh) {
    const FaceGeometry geometry = face_geometry(mesh);
    if (!(geometry.total_area > 0.0) || !std::isfinite(geometry.total_area)) {
        throw Error(ExitCode::input, "the mesh has no surface area; check the coordinates and their unit");
    }
    mesh.vertices.colwise() -= surface_centroid(geometry);
    mesh.vertices /= std::sqrt(geometry.total_area);
}

}  // namespace coseg
