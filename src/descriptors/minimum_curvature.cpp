#include "src/descriptors/minimum_curvature.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "src/base/index.hpp"
#include "src/descriptors/gaussian_curvature.hpp"
#include "src/mesh/half_edges.hpp"

namespace coseg {

namespace {

/// Curvature measure of a region, and the region's area and normal.
struct CurvatureMeasure {
    Eigen::Matrix3d tensor = Eigen::Matrix3d::Zero();       // sum of beta |e| e e^T
    Eigen::Vector3d area_normal = Eigen::Vector3d::Zero();  // area-weighted normals
    double area = 0.0;

    void add(const CurvatureMeasure& other) {
        tensor += other.tensor;
        area_normal += other.area_normal;
        area += other.area;
    }
};

/// Signed angle from the normal of the first side's face to that of the second; positive over a convex edge.
double turn(const TriMesh& mesh, const Eigen::Matrix3Xd& normals, const HalfEdge& x, const HalfEdge& y) {
    Eigen::Vector3d along = mesh.vertices.col(x.high) - mesh.vertices.col(x.low);
    if (!x.forward) along = -along;
    const Eigen::Vector3d first = normals.col(x.face);
    const Eigen::Vector3d second = normals.col(y.face);
    return std::atan2(first.cross(second).dot(along.normalized()), first.dot(second));
}

/// Each vertex takes half of the edges and a third of the faces around it.
std::vector<CurvatureMeasure> vertex_measures(const TriMesh& mesh, const FaceGeometry& geometry,
                                              const std::vector<HalfEdge>& sides) {
    const Eigen::Matrix3Xd normals = face_normals(mesh);
    std::vector<CurvatureMeasure> measure(at(mesh.vertex_count()));
    for (int f = 0; f < mesh.face_count(); ++f) {
        for (int k = 0; k < 3; ++k) {
            CurvatureMeasure& m = measure[at(mesh.faces(k, f))];
            m.area += geometry.area[f] / 3.0;
            m.area_normal += geometry.area[f] / 3.0 * normals.col(f);
        }
    }
    for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
        if (!share_edge(sides[i], sides[i + 1])) continue;
        const Eigen::Vector3d edge = mesh.vertices.col(sides[i].high) - mesh.vertices.col(sides[i].low);
        const double length = edge.norm();
        if (!(length > 0.0)) continue;
        const Eigen::Matrix3d half =
            0.5 * turn(mesh, normals, sides[i], sides[i + 1]) / length * edge * edge.transpose();
        measure[at(sides[i].low)].tensor += half;
        measure[at(sides[i].high)].tensor += half;
    }
    return measure;
}

/// Every vertex's measure plus those of its neighbours.
std::vector<CurvatureMeasure> ring_sums(const std::vector<CurvatureMeasure>& measure,
                                        const std::vector<HalfEdge>& sides) {
    std::vector<CurvatureMeasure> sum = measure;
    for (std::size_t i = 0; i < sides.size(); ++i) {
        if (i > 0 && sides[i - 1].low == sides[i].low && sides[i - 1].high == sides[i].high) continue;
        sum[at(sides[i].low)].add(measure[at(sides[i].high)]);
        sum[at(sides[i].high)].add(measure[at(sides[i].low)]);
    }
    return sum;
}

/// Eigenvalues of the measure's density in its tangent plane, ascending.
Eigen::Vector2d tangential_eigenvalues(const CurvatureMeasure& m, double smallest_area) {
    if (!(m.area_normal.norm() > 0.0)) return Eigen::Vector2d::Zero();
    const Eigen::Vector3d normal = m.area_normal.normalized();
    const Eigen::Vector3d u = normal.unitOrthogonal();
    const Eigen::Vector3d v = normal.cross(u);
    const double area = std::max(m.area, smallest_area);
    const double uu = u.dot(m.tensor * u) / area;
    const double vv = v.dot(m.tensor * v) / area;
    const double uv = u.dot(m.tensor * v) / area;
    const double mean = 0.5 * (uu + vv);
    const double spread = std::hypot(0.5 * (uu - vv), uv);
    return {mean - spread, mean + spread};
}

double percentile_95(Eigen::VectorXd values) {
    const auto nth = values.data() + (values.size() - 1) * 95 / 100;
    std::nth_element(values.data(), nth, values.data() + values.size());
    return *nth;
}

}  // namespace

PrincipalCurvatures principal_curvatures(const TriMesh& mesh, const FaceGeometry& geometry) {
    const std::vector<HalfEdge> sides = sorted_half_edges(mesh);
    const std::vector<CurvatureMeasure> measure = ring_sums(vertex_measures(mesh, geometry, sides), sides);
    const double smallest_area = 1e-12 * geometry.total_area;
    PrincipalCurvatures curvature{Eigen::VectorXd(mesh.vertex_count()), Eigen::VectorXd(mesh.vertex_count())};
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        const Eigen::Vector2d k = tangential_eigenvalues(measure[at(v)], smallest_area);
        curvature.minimum[v] = k[0];
        curvature.maximum[v] = k[1];
    }
    return curvature;
}

Eigen::VectorXd minimum_curvature(const TriMesh& mesh, const FaceGeometry& geometry) {
    if (mesh.vertex_count() == 0 || !(geometry.total_area > 0.0))
        return Eigen::VectorXd::Zero(mesh.vertex_count());
    const Eigen::VectorXd concavity = -principal_curvatures(mesh, geometry).minimum;
    const double scale = std::max(percentile_95(concavity), 1.0 / std::sqrt(geometry.total_area));
    return (concavity / scale).cwiseMax(0.0).cwiseMin(1.0);
}

}  // namespace coseg
