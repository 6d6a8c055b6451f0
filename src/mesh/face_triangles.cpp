#include "src/mesh/face_triangles.hpp"

#include "src/base/index.hpp"
#include "src/mesh/moderate_scale.hpp"
#include "src/mesh/polygon_triangulation.hpp"

namespace coseg {

std::vector<FaceTriangle> face_triangles(const PolygonMesh& mesh) {
    if (const int exponent = extreme_exponent(mesh); exponent != 0)
        return face_triangles(scaled_by_power(mesh, -exponent));
    std::vector<FaceTriangle> triangles;
    triangles.reserve(at(mesh.face_count()));
    std::vector<Eigen::Vector3d> corners;
    for (int f = 0; f < mesh.face_count(); ++f) {
        const int begin = mesh.offsets[at(f)];
        const int end = mesh.offsets[at(f) + 1];
        const auto vertex = [&](int k) { return mesh.corners[at(begin + k)]; };
        if (end - begin == 3) {
            triangles.push_back({f, {vertex(0), vertex(1), vertex(2)}});
            continue;
        }
        corners.clear();
        for (int k = begin; k < end; ++k) corners.push_back(mesh.vertices[at(mesh.corners[at(k)])]);
        for (const Eigen::Vector3i& t : triangulate_polygon(corners))
            triangles.push_back({f, {vertex(t[0]), vertex(t[1]), vertex(t[2])}});
    }
    return triangles;
}

}  // namespace coseg
