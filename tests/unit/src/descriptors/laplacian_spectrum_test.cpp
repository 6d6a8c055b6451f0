#include "src/descriptors/laplacian_spectrum.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "src/descriptors/gaussian_curvature.hpp"
#include "tests/support/shapes.hpp"

namespace coseg {
namespace {

LaplacianSpectrum spectrum_of(const TriMesh& mesh, int pairs = 100) {
    const FaceGeometry geometry = face_geometry(mesh);
    return laplacian_spectrum(mesh, geometry, dual_graph(mesh, geometry), pairs);
}

void expect_orthonormal(const TriMesh& mesh, const LaplacianSpectrum& spectrum) {
    const Eigen::VectorXd area = vertex_areas(mesh, face_geometry(mesh));
    const Eigen::MatrixXd inner =
        spectrum.eigenfunctions.transpose() * area.asDiagonal() * spectrum.eigenfunctions;
    const Eigen::Index k = spectrum.eigenvalues.size();
    EXPECT_LT((inner - Eigen::MatrixXd::Identity(k, k)).cwiseAbs().maxCoeff(), 1e-6);
}

// The unit sphere has l (l + 1) with 2 l + 1 eigenfunctions, l = 1, 2, ...; l = 9 ends with the 99th. Linear
// elements are of second order: an eigenvalue is off by its own square times that of the edges' length.
TEST(LaplacianSpectrum, OfASphereIsKnownWithItsMultiplicities) {
    const TriMesh mesh = test::sphere(4);
    const LaplacianSpectrum spectrum = spectrum_of(mesh);
    ASSERT_EQ(spectrum.eigenvalues.size(), 99);
    Eigen::Index k = 0;
    for (int l = 1; l <= 9; ++l) {
        for (int m = 0; m < 2 * l + 1; ++m, ++k)
            EXPECT_NEAR(spectrum.eigenvalues[k], l * (l + 1), 5e-4 * l * (l + 1) * l * (l + 1))
                << l << " " << m;
    }
    expect_orthonormal(mesh, spectrum);
}

// The unit square with a free border has pi^2 (a^2 + b^2), a and b from 0 on.
TEST(LaplacianSpectrum, OfASquareWithABorderIsKnown) {
    const TriMesh mesh = test::flat_square(40);
    const LaplacianSpectrum spectrum = spectrum_of(mesh, 8);
    const std::vector<double> squares = {1, 1, 2, 4, 4, 5, 5, 8};
    ASSERT_EQ(spectrum.eigenvalues.size(), 8);
    for (Eigen::Index k = 0; k < 8; ++k)
        EXPECT_NEAR(spectrum.eigenvalues[k],
                    std::numbers::pi * std::numbers::pi * squares[static_cast<std::size_t>(k)],
                    0.02 * std::numbers::pi * std::numbers::pi * squares[static_cast<std::size_t>(k)])
            << k;
    expect_orthonormal(mesh, spectrum);
}

TEST(LaplacianSpectrum, IsOneOverTheAreaInItsUnit) {
    const LaplacianSpectrum small = spectrum_of(test::torus(2.0, 0.7, 40, 20), 30);
    const LaplacianSpectrum large = spectrum_of(test::torus(20.0, 7.0, 40, 20), 30);
    ASSERT_EQ(small.eigenvalues.size(), large.eigenvalues.size());
    EXPECT_LT((small.eigenvalues - 100.0 * large.eigenvalues).cwiseAbs().maxCoeff(),
              1e-6 * small.eigenvalues.maxCoeff());
}

TEST(LaplacianSpectrum, OfTwoComponentsHasOneConstantAndASlowSwingBetweenThem) {
    TriMesh far = test::sphere(3);
    far.vertices.row(0).array() += 3.0;
    const TriMesh mesh = test::disjoint_union(test::sphere(3), far);
    const LaplacianSpectrum spectrum = spectrum_of(mesh, 40);
    // The lowest takes opposite signs on the two; then those of a sphere, twice each, shifted a little by the
    // spring.
    EXPECT_GT(spectrum.eigenvalues[0], 0.01);
    EXPECT_LT(spectrum.eigenvalues[0], 0.5);
    const Eigen::Index half = mesh.vertex_count() / 2;
    EXPECT_LT(
        spectrum.eigenfunctions.col(0).head(half).mean() * spectrum.eigenfunctions.col(0).tail(half).mean(),
        0.0);
    for (Eigen::Index k = 1; k < 7; ++k) EXPECT_NEAR(spectrum.eigenvalues[k], 2.0, 0.6) << k;
    for (Eigen::Index k = 7; k < 17; ++k) EXPECT_NEAR(spectrum.eigenvalues[k], 6.0, 1.2) << k;
    expect_orthonormal(mesh, spectrum);
}

TEST(LaplacianSpectrum, OfFewVerticesIsAllThereIs) {
    const TriMesh mesh = test::sphere(0);
    const LaplacianSpectrum spectrum = spectrum_of(mesh);
    EXPECT_EQ(spectrum.eigenvalues.size(), 11);
    EXPECT_GT(spectrum.eigenvalues[0], 0.0);
    expect_orthonormal(mesh, spectrum);
}

TEST(LaplacianSpectrum, DoesNotCutThroughAGroupOfEqualEigenvalues) {
    // The symmetry of the icosahedron, from which the mesh is made, leaves groups of three to five.
    const TriMesh mesh = test::sphere(3);
    const Eigen::VectorXd all = spectrum_of(mesh, 120).eigenvalues;
    const auto gap_behind = [&](Eigen::Index count) { return all[count] / all[count - 1] - 1.0; };
    const Eigen::Index kept = spectrum_of(mesh, 90).eigenvalues.size();
    EXPECT_LT(gap_behind(90), 1e-6) << "90 would cut through no group";
    EXPECT_GT(gap_behind(kept), 1e-3);
    EXPECT_LT(kept, 90);
    EXPECT_GE(kept, 81);
}

}  // namespace
}  // namespace coseg
