#include "src/mesh/face_geometry.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "src/base/error.hpp"

namespace coseg {

namespace {

using Corners = std::array<Eigen::Vector3d, 3>;

Corners corners_of(const TriMesh& mesh, int face) {
    return {mesh.vertices.col(mesh.faces(0, face)), mesh.vertices.col(mesh.faces(1, face)),
            mesh.vertices.col(mesh.faces(2, face))};
}

/// Along the normal, twice as long as the area.
Eigen::Vector3d doubled_area_normal(const Corners& corners) {
    const auto& [a, b, c] = corners;
    return (b - a).cross(c - a);
}

}  // namespace

FaceGeometry face_geometry(const TriMesh& mesh) {
    const int faces = mesh.face_count();
    FaceGeometry geometry;
    geometry.area.resize(faces);
    geometry.centroid.resize(3, faces);
    for (int f = 0; f < faces; ++f) {
        const Corners corners = corners_of(mesh, f);
        geometry.area[f] = 0.5 * doubled_area_normal(corners).norm();
        geometry.centroid.col(f) = (corners[0] + corners[1] + corners[2]) / 3.0;
        geometry.total_area += geometry.area[f];
    }
    return geometry;
}

Eigen::Matrix3Xd face_normals(const TriMesh& mesh) {
    Eigen::Matrix3Xd normals = Eigen::Matrix3Xd::Zero(3, mesh.face_count());
    for (int f = 0; f < mesh.face_count(); ++f) {
        const Eigen::Vector3d doubled = doubled_area_normal(corners_of(mesh, f));
        const double length = doubled.norm();
        if (length > 0.0) normals.col(f) = doubled / length;
    }
    return normals;
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
