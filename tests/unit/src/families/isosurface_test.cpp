#include "src/families/isosurface.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "src/base/error.hpp"
#include "src/base/seeded_random.hpp"
#include "tests/support/surface_checks.hpp"

namespace coseg {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

AlignedBox3d cube(double half) { return {Vector3d::Constant(-half), Vector3d::Constant(half)}; }

double ball(const Vector3d& p) { return p.norm() - 1.0; }

void expect_closed_manifold(const TriMesh& mesh) {
    EXPECT_TRUE(test::is_closed_and_oriented(mesh));
    EXPECT_TRUE(test::has_single_fans(mesh));
    EXPECT_GT(test::volume(mesh), 0.0);
}

TEST(Isosurface, SphereHasItsAreaVolumeAndTopology) {
    const TriMesh mesh = isosurface(ball, cube(1.0), 0.06);
    expect_closed_manifold(mesh);
    EXPECT_EQ(test::component_count(mesh), 1);
    EXPECT_EQ(test::euler_characteristic(mesh), 2);
    EXPECT_NEAR(face_geometry(mesh).total_area, 4.0 * std::numbers::pi, 0.02 * 4.0 * std::numbers::pi);
    EXPECT_NEAR(test::volume(mesh), 4.0 / 3.0 * std::numbers::pi, 0.01 * 4.0 / 3.0 * std::numbers::pi);
}

TEST(Isosurface, VerticesLieWithinATenthOfTheSpacing) {
    const double spacing = 0.1;
    const TriMesh mesh = isosurface(ball, cube(1.0), spacing);
    const double curvature_error = spacing * spacing / 8.0;  // of the linear interpolation along an edge
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        EXPECT_LE(std::abs(ball(mesh.vertices.col(v))), 0.1 * spacing + curvature_error);
    }
}

TEST(Isosurface, TorusIsATorus) {
    const auto torus = [](const Vector3d& p) { return std::hypot(p.head<2>().norm() - 1.0, p[2]) - 0.3; };
    const TriMesh mesh = isosurface(torus, cube(1.3), 0.07);
    expect_closed_manifold(mesh);
    EXPECT_EQ(test::euler_characteristic(mesh), 0);
}

TEST(Isosurface, TwoBallsAreTwoComponents) {
    const auto balls = [](const Vector3d& p) {
        return std::min((p - Vector3d(1, 0, 0)).norm(), (p + Vector3d(1, 0, 0)).norm()) - 0.5;
    };
    const TriMesh mesh = isosurface(balls, cube(1.5), 0.1);
    EXPECT_EQ(test::component_count(mesh), 2);
    EXPECT_EQ(test::euler_characteristic(mesh), 4);
}

TEST(Isosurface, PassingOverEmptyBlocksChangesNothing) {
    const TriMesh all = isosurface(ball, cube(1.0), 0.07);
    const TriMesh passed = isosurface(ball, cube(1.0), 0.07, 1.0);
    ASSERT_TRUE(all.faces == passed.faces);
    EXPECT_EQ((all.vertices - passed.vertices).cwiseAbs().maxCoeff(), 0.0);
}

TEST(Isosurface, NoiseStillGivesAClosedManifold) {
    // Signs without any order: every case of the tetrahedra, and values of exactly zero, which count as
    // outside.
    const auto noise = [](const Vector3d& p) {
        if (p.cwiseAbs().maxCoeff() > 1.0) return 1.0;
        const auto cell = [](double x) {
            return static_cast<std::uint64_t>(std::llround(x * 1000.0) + 100000);
        };
        const double u = uniform_of(hash_words({cell(p[0]), cell(p[1]), cell(p[2])}));
        return u < 0.1 ? 0.0 : u - 0.5;
    };
    const TriMesh mesh = isosurface(noise, cube(1.0), 0.2);
    EXPECT_GT(mesh.face_count(), 1000);
    expect_closed_manifold(mesh);
}

TEST(Isosurface, RefusesASolidThatReachesTheEdgeAndASpacingOfNone) {
    EXPECT_THROW(isosurface(ball, cube(0.5), 0.1), Error);
    EXPECT_THROW(isosurface(ball, cube(1.0), 0.0), Error);
    EXPECT_THROW(isosurface(ball, cube(1.0), 1e-4), Error);
}

}  // namespace
}  // namespace coseg
