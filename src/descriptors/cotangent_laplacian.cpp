#include "src/descriptors/cotangent_laplacian.hpp"

#include <Eigen/Geometry>
#include <numbers>
#include <vector>

#include "src/base/index.hpp"

namespace coseg {

namespace {

/// Half the cotangent at every corner of a face; those of an equilateral face if it is too thin, or if asked
/// for.
Eigen::Vector3d half_cotangents(const TriMesh& mesh, int f, LaplacianWeights weights) {
    constexpr double thinnest = 1e-6;  // height over longest edge
    constexpr double equilateral = 0.5 * std::numbers::inv_sqrt3;
    Eigen::Matrix3d edge;  // opposite the corner
    for (int k = 0; k < 3; ++k) {
        edge.col(k) =
            mesh.vertices.col(mesh.faces((k + 2) % 3, f)) - mesh.vertices.col(mesh.faces((k + 1) % 3, f));
    }
    const double double_area = edge.col(0).cross(edge.col(1)).norm();
    const double longest = edge.colwise().squaredNorm().maxCoeff();
    if (weights == LaplacianWeights::uniform || !(double_area > thinnest * longest))
        return Eigen::Vector3d::Constant(equilateral);
    Eigen::Vector3d cotangent;
    for (int k = 0; k < 3; ++k)
        cotangent[k] = -edge.col((k + 1) % 3).dot(edge.col((k + 2) % 3)) / double_area;
    return 0.5 * cotangent;
}

}  // namespace

Eigen::SparseMatrix<double> cotangent_laplacian(const TriMesh& mesh, LaplacianWeights weights) {
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(at(mesh.face_count()) * 12);
    for (int f = 0; f < mesh.face_count(); ++f) {
        const Eigen::Vector3d weight = half_cotangents(mesh, f, weights);
        for (int k = 0; k < 3; ++k) {
            const int a = mesh.faces((k + 1) % 3, f);
            const int b = mesh.faces((k + 2) % 3, f);
            entries.emplace_back(a, b, -weight[k]);
            entries.emplace_back(b, a, -weight[k]);
            entries.emplace_back(a, a, weight[k]);
            entries.emplace_back(b, b, weight[k]);
        }
    }
    Eigen::SparseMatrix<double> laplacian(mesh.vertex_count(), mesh.vertex_count());
    laplacian.setFromTriplets(entries.begin(), entries.end());
    return laplacian;
}

}  // namespace coseg
