#include "src/descriptors/conformal_factor.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "src/base/disjoint_sets.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/descriptors/cotangent_laplacian.hpp"
#include "src/descriptors/gaussian_curvature.hpp"

namespace coseg {

namespace {

using SparseMatrix = Eigen::SparseMatrix<double>;

/// The vertices of each component (joined by faces), numbered by lowest vertex.
struct VertexComponents {
    std::vector<int> of_vertex;
    std::vector<int> first_vertex;  // per component
    [[nodiscard]] Eigen::Index count() const { return static_cast<Eigen::Index>(first_vertex.size()); }
};

VertexComponents vertex_components(const TriMesh& mesh) {
    DisjointSets sets(at(mesh.vertex_count()));
    for (int f = 0; f < mesh.face_count(); ++f) {
        for (int k = 1; k < 3; ++k) sets.join(mesh.faces(0, f), mesh.faces(k, f));
    }
    VertexComponents components;
    components.of_vertex.resize(at(mesh.vertex_count()));
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        const int r = sets.lowest(v);
        if (r == v) components.first_vertex.push_back(v);
        components.of_vertex[at(v)] =
            r == v ? static_cast<int>(components.count()) - 1 : components.of_vertex[at(r)];
    }
    return components;
}

/// L, with the first vertex of every component pinned: its diagonal entry is doubled (or 1), which removes
/// the constant mode and changes nothing else, because right-hand sides that sum to zero give that vertex the
/// value 0.
SparseMatrix pinned_laplacian(const TriMesh& mesh, const VertexComponents& components, bool uniform) {
    SparseMatrix laplacian =
        cotangent_laplacian(mesh, uniform ? LaplacianWeights::uniform : LaplacianWeights::cotangent);
    for (const int v : components.first_vertex) {
        const double diagonal = laplacian.coeff(v, v);
        laplacian.coeffRef(v, v) += diagonal > 0.0 ? diagonal : 1.0;
    }
    return laplacian;
}

/// Sums of vertex values over each component.
Eigen::VectorXd component_sums(const VertexComponents& components, const Eigen::VectorXd& values) {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(components.count());
    for (Eigen::Index v = 0; v < values.size(); ++v) sum[components.of_vertex[at(v)]] += values[v];
    return sum;
}

/// K_target - K; sums to zero over each component, to rounding.
Eigen::VectorXd curvature_to_spread(const TriMesh& mesh, const VertexComponents& components,
                                    const Eigen::VectorXd& area) {
    const Eigen::VectorXd curvature = angle_defects(mesh);
    const Eigen::VectorXd curvature_sum = component_sums(components, curvature);
    const Eigen::VectorXd area_sum = component_sums(components, area);
    Eigen::VectorXd difference(mesh.vertex_count());
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        const int c = components.of_vertex[at(v)];
        difference[v] = curvature_sum[c] * area[v] / area_sum[c] - curvature[v];
    }
    return difference;
}

std::optional<Eigen::VectorXd> solve(const SparseMatrix& laplacian, const Eigen::VectorXd& right_side) {
    constexpr double largest_residual = 1e-6;
    const Eigen::SimplicialLDLT<SparseMatrix> factors(laplacian);
    if (factors.info() != Eigen::Success) return std::nullopt;
    const Eigen::VectorXd solution = factors.solve(right_side);
    const double residual = (laplacian * solution - right_side).norm();
    if (!(residual <= largest_residual * right_side.norm() + 1e-12)) return std::nullopt;
    return solution;
}

void subtract_component_means(const VertexComponents& components, const Eigen::VectorXd& weight,
                              Eigen::VectorXd& phi) {
    const Eigen::VectorXd sum = component_sums(components, phi.cwiseProduct(weight));
    const Eigen::VectorXd total = component_sums(components, weight);
    for (Eigen::Index v = 0; v < phi.size(); ++v) {
        const int c = components.of_vertex[at(v)];
        phi[v] -= sum[c] / total[c];
    }
}

}  // namespace

Eigen::VectorXd conformal_factor(const TriMesh& mesh, const FaceGeometry& geometry) {
    if (mesh.face_count() == 0) return {};
    const VertexComponents components = vertex_components(mesh);
    // A share of the mean area for every vertex keeps components without area away from 0 / 0; 1e-14 of it is
    // rounding.
    Eigen::VectorXd area = vertex_areas(mesh, geometry);
    const double mean_area = geometry.total_area / mesh.vertex_count();
    area.array() += mean_area > 0.0 ? 1e-14 * mean_area : 1.0;

    const Eigen::VectorXd right_side = curvature_to_spread(mesh, components, area);
    std::optional<Eigen::VectorXd> phi = solve(pinned_laplacian(mesh, components, false), right_side);
    if (!phi) phi = solve(pinned_laplacian(mesh, components, true), right_side);
    if (!phi) {
        throw Error(ExitCode::internal,
                    "the Laplacian of a mesh with " + std::to_string(mesh.face_count()) +
                        " faces cannot be factorised; check that its coordinates are finite");
    }
    subtract_component_means(components, area, *phi);
    return mean_of_corners(mesh, *phi);
}

}  // namespace coseg
