#include "src/mesh/polygon_area.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "src/mesh/moderate_scale.hpp"

namespace coseg {
namespace {

double fan_area(const PolygonMesh& mesh, int face) {
    const int begin = mesh.offsets[face];
    const int end = mesh.offsets[face + 1];
    double area = 0.0;
    for (int corner = begin + 1; corner + 1 < end; ++corner) {
        const Eigen::Vector3d& origin = mesh.vertices[mesh.corners[begin]];
        const Eigen::Vector3d first_side = mesh.vertices[mesh.corners[corner]] - origin;
        const Eigen::Vector3d second_side = mesh.vertices[mesh.corners[corner + 1]] - origin;
        area += 0.5 * first_side.cross(second_side).norm();
    }
    return area;
}

}  // namespace

std::vector<double> polygon_areas(const PolygonMesh& mesh) {
    std::vector<double> areas = relative_areas(mesh);
    if (const int exponent = extreme_exponent(mesh); exponent != 0) {
        for (double& area : areas) area = std::ldexp(area, 2 * exponent);
    }
    return areas;
}

std::vector<double> relative_areas(const PolygonMesh& mesh) {
    if (const int exponent = extreme_exponent(mesh); exponent != 0)
        return relative_areas(scaled_by_power(mesh, -exponent));
    std::vector<double> areas(mesh.face_count());
    for (int face = 0; face < mesh.face_count(); ++face) areas[face] = fan_area(mesh, face);
    return areas;
}

}  // namespace coseg
