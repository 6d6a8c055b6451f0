#include "src/descriptors/gaussian_curvature.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "src/base/index.hpp"
#include "src/mesh/half_edges.hpp"

namespace coseg {

namespace {

constexpr double pi = std::numbers::pi;

std::vector<bool> boundary_vertices(const TriMesh& mesh) {
    std::vector<bool> on_boundary(at(mesh.vertex_count()), false);
    const std::vector<HalfEdge> sides = sorted_half_edges(mesh);
    for (std::size_t i = 0; i < sides.size(); ++i) {
        const bool paired = (i > 0 && share_edge(sides[i - 1], sides[i])) ||
                            (i + 1 < sides.size() && share_edge(sides[i], sides[i + 1]));
        if (paired) continue;
        on_boundary[at(sides[i].low)] = true;
        on_boundary[at(sides[i].high)] = true;
    }
    return on_boundary;
}

/// At `b` of the triangle a b c, which may be degenerate; the three angles of a triangle always sum to pi.
double corner_angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
    const Eigen::Vector3d to_a = a - b;
    const Eigen::Vector3d to_c = c - b;
    if (a == c) return b == a ? pi / 3 : 0.0;
    if (a == b || b == c) return pi / 2;
    return std::atan2(to_a.cross(to_c).norm(), to_a.dot(to_c));
}

}  // namespace

Eigen::VectorXd angle_defects(const TriMesh& mesh) {
    Eigen::VectorXd angle_sum = Eigen::VectorXd::Zero(mesh.vertex_count());
    std::vector<bool> used(at(mesh.vertex_count()), false);
    for (int f = 0; f < mesh.face_count(); ++f) {
        for (int k = 0; k < 3; ++k) {
            const int v = mesh.faces(k, f);
            used[at(v)] = true;
            angle_sum[v] += corner_angle(mesh.vertices.col(mesh.faces((k + 2) % 3, f)), mesh.vertices.col(v),
                                         mesh.vertices.col(mesh.faces((k + 1) % 3, f)));
        }
    }
    const std::vector<bool> on_boundary = boundary_vertices(mesh);
    Eigen::VectorXd defect = Eigen::VectorXd::Zero(mesh.vertex_count());
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        const auto i = at(v);
        if (used[i]) defect[v] = (on_boundary[i] ? pi : 2 * pi) - angle_sum[v];
    }
    return defect;
}

Eigen::VectorXd vertex_areas(const TriMesh& mesh, const FaceGeometry& geometry) {
    Eigen::VectorXd area = Eigen::VectorXd::Zero(mesh.vertex_count());
    for (int f = 0; f < mesh.face_count(); ++f) {
        for (int k = 0; k < 3; ++k) area[mesh.faces(k, f)] += geometry.area[f] / 3.0;
    }
    return area;
}

Eigen::VectorXd mean_of_corners(const TriMesh& mesh, const Eigen::VectorXd& vertex_values) {
    Eigen::VectorXd mean(mesh.face_count());
    for (int f = 0; f < mesh.face_count(); ++f) {
        mean[f] = (vertex_values[mesh.faces(0, f)] + vertex_values[mesh.faces(1, f)] +
                   vertex_values[mesh.faces(2, f)]) /
                  3;
    }
    return mean;
}

Eigen::VectorXd gaussian_curvature(const TriMesh& mesh, const FaceGeometry& geometry) {
    const double smallest_area = 1e-12 * geometry.total_area;
    if (!(smallest_area > 0.0)) return Eigen::VectorXd::Zero(mesh.face_count());
    const Eigen::VectorXd area = vertex_areas(mesh, geometry);
    Eigen::VectorXd curvature = angle_defects(mesh);
    for (int v = 0; v < mesh.vertex_count(); ++v) curvature[v] /= std::max(area[v], smallest_area);
    return mean_of_corners(mesh, curvature);
}

}  // namespace coseg
