#include "src/pictures/picture_mesh.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "src/base/index.hpp"
#include "src/mesh/moderate_scale.hpp"
#include "src/mesh/polygon_triangulation.hpp"
#include "src/mesh/vertex_welding.hpp"

namespace coseg {

namespace {

/// Vertices without a triangle do not influence the picture.
void scale_into_unit_ball(TriMesh& mesh) {
    if (mesh.face_count() == 0) return;
    Eigen::Vector3d low = mesh.vertices.col(mesh.faces(0, 0));
    Eigen::Vector3d high = low;
    for (const int v : mesh.faces.reshaped()) {
        low = low.cwiseMin(mesh.vertices.col(v));
        high = high.cwiseMax(mesh.vertices.col(v));
    }
    mesh.vertices.colwise() -= 0.5 * (low + high);
    double radius = 0.0;
    for (const int v : mesh.faces.reshaped()) radius = std::max(radius, mesh.vertices.col(v).norm());
    if (radius > 0.0) mesh.vertices /= radius;
}

std::vector<std::vector<int>> triangles_of_vertices(const TriMesh& mesh) {
    std::vector<std::vector<int>> triangles(at(mesh.vertex_count()));
    for (int f = 0; f < mesh.face_count(); ++f) {
        for (int k = 0; k < 3; ++k) triangles[at(mesh.faces(k, f))].push_back(f);
    }
    return triangles;
}

/// Twice the area times the unit normal.
Eigen::Matrix3Xd area_normals(const TriMesh& mesh) {
    Eigen::Matrix3Xd normals(3, mesh.faces.cols());
    for (int f = 0; f < mesh.face_count(); ++f) {
        const Eigen::Vector3d a = mesh.vertices.col(mesh.faces(0, f));
        const Eigen::Vector3d b = mesh.vertices.col(mesh.faces(1, f));
        const Eigen::Vector3d c = mesh.vertices.col(mesh.faces(2, f));
        normals.col(f) = (b - a).cross(c - a);
    }
    return normals;
}

}  // namespace

PictureMesh picture_mesh(const PolygonMesh& mesh, const std::vector<Color>& color_of_face) {
    if (const int exponent = extreme_exponent(mesh); exponent != 0)
        return picture_mesh(scaled_by_power(mesh, -exponent), color_of_face);
    const std::vector<int> stand_for = weld_vertices(mesh);
    std::vector<Eigen::Vector3i> triangles;
    PictureMesh picture;
    for (int f = 0; f < mesh.face_count(); ++f) {
        std::vector<int> vertices;
        std::vector<Eigen::Vector3d> corners;
        const auto face = at(f);
        for (int k = mesh.offsets[face]; k < mesh.offsets[face + 1]; ++k) {
            vertices.push_back(stand_for[at(mesh.corners[at(k)])]);
            corners.push_back(mesh.vertices[at(vertices.back())]);
        }
        for (const Eigen::Vector3i& t : triangulate_polygon(corners)) {
            triangles.emplace_back(vertices[at(t[0])], vertices[at(t[1])], vertices[at(t[2])]);
            picture.colors.push_back(color_of_face[face]);
            picture.faces.push_back(f);
        }
    }
    picture.mesh.vertices.resize(3, mesh.vertex_count());
    for (int v = 0; v < mesh.vertex_count(); ++v) picture.mesh.vertices.col(v) = mesh.vertices[at(v)];
    picture.mesh.faces.resize(3, static_cast<Eigen::Index>(triangles.size()));
    for (std::size_t t = 0; t < triangles.size(); ++t)
        picture.mesh.faces.col(static_cast<Eigen::Index>(t)) = triangles[t];
    scale_into_unit_ball(picture.mesh);
    return picture;
}

PictureMesh picture_mesh(const TriMesh& mesh, const std::vector<Color>& color_of_face) {
    PictureMesh picture{mesh, color_of_face, std::vector<int>(color_of_face.size())};
    std::iota(picture.faces.begin(), picture.faces.end(), 0);
    scale_into_unit_ball(picture.mesh);
    return picture;
}

Eigen::Matrix3Xf corner_normals(const TriMesh& mesh, double crease_degrees) {
    const double least_cosine = std::cos(crease_degrees * std::numbers::pi / 180.0);
    const Eigen::Matrix3Xd weighted = area_normals(mesh);
    const Eigen::Matrix3Xd unit = weighted.colwise().normalized();
    const std::vector<std::vector<int>> around = triangles_of_vertices(mesh);
    Eigen::Matrix3Xf normals(3, 3 * mesh.faces.cols());
    for (int f = 0; f < mesh.face_count(); ++f) {
        for (int k = 0; k < 3; ++k) {
            Eigen::Vector3d sum = Eigen::Vector3d::Zero();
            for (const int other : around[at(mesh.faces(k, f))]) {
                if (unit.col(other).dot(unit.col(f)) >= least_cosine) sum += weighted.col(other);
            }
            normals.col(3 * static_cast<Eigen::Index>(f) + k) = sum.normalized().cast<float>();
        }
    }
    return normals;
}

}  // namespace coseg
