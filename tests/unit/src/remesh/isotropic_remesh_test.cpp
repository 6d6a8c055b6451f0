#include "src/remesh/isotropic_remesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "src/base/error.hpp"
#include "src/base/seeded_random.hpp"
#include "src/families/shape_families.hpp"
#include "src/mesh/closest_point.hpp"
#include "tests/support/read_off.hpp"
#include "tests/support/shapes.hpp"
#include "tests/support/surface_checks.hpp"

namespace coseg {
namespace {

using Eigen::Vector3d;

double area(const TriMesh& mesh) { return face_geometry(mesh).total_area; }

void expect_even(const TriMesh& mesh, double edge_length) {
    const std::vector<double> angles = test::smallest_angles(mesh);
    EXPECT_GT(angles[angles.size() / 20], 30.0);
    const FaceGeometry geometry = face_geometry(mesh);
    const double mean = geometry.total_area / mesh.face_count();
    const double deviation = std::sqrt((geometry.area.array() - mean).square().mean());
    EXPECT_LT(deviation, 0.35 * mean);
    EXPECT_NEAR(std::sqrt(mean * 4.0 / std::sqrt(3.0)), edge_length, 0.1 * edge_length);
}

TEST(IsotropicRemesh, SphereKeepsAreaVolumeAndTopologyAtManyLengths) {
    const TriMesh fine = test::sphere(4);
    for (const double length : {0.06, 0.12, 0.25}) {
        const TriMesh mesh = isotropic_remesh(fine, {.edge_length = length, .iterations = 8});
        EXPECT_TRUE(test::is_closed_and_oriented(mesh));
        EXPECT_TRUE(test::has_single_fans(mesh));
        EXPECT_EQ(test::euler_characteristic(mesh), 2);
        const double chord_error = length * length;  // of a polyhedron with vertices on the unit sphere
        EXPECT_NEAR(area(mesh), area(fine), (0.002 + 0.5 * chord_error) * area(fine));
        EXPECT_NEAR(test::volume(mesh), test::volume(fine), (0.002 + chord_error) * test::volume(fine));
        expect_even(mesh, length);
    }
}

TEST(IsotropicRemesh, FollowsTheGivenProjection) {
    const SurfaceProjection onto_sphere = [](const Vector3d& p, const Vector3d&) { return p.normalized(); };
    const TriMesh mesh = isotropic_remesh(test::sphere(1), {.edge_length = 0.1}, onto_sphere);
    for (int v = 0; v < mesh.vertex_count(); ++v) EXPECT_NEAR(mesh.vertices.col(v).norm(), 1.0, 1e-12);
    EXPECT_GT(mesh.face_count(), 2000);
}

TEST(IsotropicRemesh, FaceCountIsThatOfTheWantedLength) {
    const TriMesh torus = test::torus(1.0, 0.4, 150, 60);
    for (const int faces : {1500, 4000, 7000}) {
        const TriMesh mesh = isotropic_remesh(torus, {.edge_length = edge_length_for(area(torus), faces)});
        EXPECT_NEAR(mesh.face_count(), faces, 0.12 * faces);
        EXPECT_EQ(test::euler_characteristic(mesh), 0);
    }
}

TEST(IsotropicRemesh, ThinLimbsGetShorterEdgesOnRequest) {
    const TriMesh rod = test::torus(1.0, 0.08, 200, 16);
    const TriMesh even = isotropic_remesh(rod, {.edge_length = 0.12});
    const TriMesh shorter = isotropic_remesh(rod, {.edge_length = 0.12, .smallest_share = 0.6});
    EXPECT_GT(shorter.face_count(), 1.8 * even.face_count());
    EXPECT_LT(shorter.face_count(), 3.2 * even.face_count());
    EXPECT_TRUE(test::is_closed_and_oriented(shorter));
    EXPECT_NEAR(test::volume(shorter), test::volume(rod), 0.12 * test::volume(rod));
}

TEST(IsotropicRemesh, SharpEdgesOfABoxStay) {
    const TriMesh box = test::box(1.0, 0.6, 0.4, 8);
    const TriMesh mesh = isotropic_remesh(box, {.edge_length = 0.07, .iterations = 8, .sharp_angle = 0.7});
    EXPECT_TRUE(test::is_closed_and_oriented(mesh));
    EXPECT_NEAR(test::volume(mesh), 0.24, 1e-9);
    EXPECT_NEAR(area(mesh), 2 * (0.6 + 0.4 + 0.24), 1e-9);
    for (const double x : {0.0, 1.0}) {
        const Vector3d corner(x, 0.6, 0.4);
        EXPECT_LT((mesh.vertices.colwise() - corner).colwise().norm().minCoeff(), 1e-12);
    }
}

TEST(IsotropicRemesh, BoundaryOfASquareStays) {
    const TriMesh mesh = isotropic_remesh(test::flat_square(40), {.edge_length = 0.05});
    EXPECT_NEAR(area(mesh), 1.0, 1e-9);
    EXPECT_NEAR(mesh.vertices.row(0).minCoeff(), 0.0, 1e-12);
    EXPECT_NEAR(mesh.vertices.row(1).maxCoeff(), 1.0, 1e-12);
    expect_even(mesh, 0.05);
}

TEST(IsotropicRemesh, ScaleChangesNothingButTheScale) {
    TriMesh small = test::torus(1.0, 0.4, 40, 16);
    const TriMesh reference = isotropic_remesh(small, {.edge_length = 0.125});
    small.vertices *= 0x1p-27;
    const TriMesh scaled = isotropic_remesh(small, {.edge_length = 0.125 * 0x1p-27});
    ASSERT_EQ(scaled.faces, reference.faces);
    EXPECT_LT((scaled.vertices * 0x1p27 - reference.vertices).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(IsotropicRemesh, LabelsTravelToTheNewMeshAndBack) {
    const TriMesh sphere = test::sphere(4);
    const FaceGeometry geometry = face_geometry(sphere);
    const TriMesh mesh = isotropic_remesh(sphere, {.edge_length = 0.08});
    const FaceGeometry remeshed = face_geometry(mesh);
    const std::vector<int> nearest = nearest_faces(sphere, mesh);
    double right = 0.0;
    for (int f = 0; f < sphere.face_count(); ++f) {
        const bool upper = geometry.centroid(2, f) > 0.0;
        if (upper == (remeshed.centroid(2, nearest[f]) > 0.0)) right += geometry.area[f];
    }
    EXPECT_GT(right / geometry.total_area, 0.97);
}

TEST(IsotropicRemesh, RefusesNonManifoldInputAndBadLengths) {
    TriMesh fan;
    fan.vertices.resize(3, 5);
    fan.vertices << 0, 1, 0, 0, 0, 0, 0, 1, -1, 0, 0, 0, 0, 0, 1;
    fan.faces.resize(3, 3);
    fan.faces << 0, 0, 0, 1, 1, 1, 2, 3, 4;  // three faces on the edge 0-1
    EXPECT_THROW(isotropic_remesh(fan, {.edge_length = 0.1}), Error);
    EXPECT_THROW(isotropic_remesh(test::sphere(1), {.edge_length = 0.0}), Error);
    EXPECT_THROW(isotropic_remesh(test::sphere(1), {.edge_length = std::nan("")}), Error);
}

void expect_volume_and_topology_kept(const TriMesh& input) {
    const TriMesh mesh =
        isotropic_remesh(input, {.edge_length = edge_length_for(area(input), 6000), .smallest_share = 0.6});
    EXPECT_TRUE(test::is_closed_and_oriented(mesh));
    EXPECT_EQ(test::euler_characteristic(mesh), test::euler_characteristic(input));
    EXPECT_NEAR(area(mesh), area(input), 0.02 * area(input));
    EXPECT_NEAR(test::volume(mesh), test::volume(input), 0.01 * test::volume(input));
    const std::vector<double> angles = test::smallest_angles(mesh);
    EXPECT_GT(angles[angles.size() / 20], 25.0);
}

TEST(IsotropicRemesh, GeneratedMeshesKeepTheirVolumeAndTopology) {
    expect_volume_and_topology_kept(generate_shape("pliers", 1, 0, 6000).mesh);
}

TEST(IsotropicRemesh, RealMeshesKeepTheirVolumeAndTopology) {
    const std::filesystem::path path = test::data_folder() / "psb_plier" / "201.off";
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not here; set COSEG_DATA";
    expect_volume_and_topology_kept(test::read_off(path));
}

TEST(ClosestPoint, AgreesWithAllFacesTried) {
    const TriMesh mesh = test::torus(1.0, 0.3, 20, 10);
    const ClosestPointTree tree(mesh);
    SeededStream random(5);
    for (int trial = 0; trial < 200; ++trial) {
        const Vector3d p(random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-1, 1));
        const ClosestPoint nearest = tree.nearest(p);
        double best = 1e300;
        for (int f = 0; f < mesh.face_count(); ++f) {
            TriMesh one;
            one.vertices = mesh.vertices;
            one.faces = mesh.faces.col(f);
            best = std::min(best, ClosestPointTree(one).nearest(p).distance);
        }
        EXPECT_DOUBLE_EQ(nearest.distance, best);
        EXPECT_NEAR((nearest.point - p).norm(), nearest.distance, 1e-14);
    }
}

TEST(ClosestPoint, KnowsTheRegionsOfATriangleAndKeepsToTheSideAsked) {
    TriMesh square = test::box(1.0, 1.0, 0.01, 1);
    const ClosestPointTree tree(square);
    EXPECT_LT((tree.nearest({0.5, 0.25, 2.0}).point - Vector3d(0.5, 0.25, 0.01)).norm(), 1e-14);
    EXPECT_LT((tree.nearest({-1.0, 0.5, 0.005}).point - Vector3d(0.0, 0.5, 0.005)).norm(), 1e-14);
    EXPECT_LT((tree.nearest({2.0, 2.0, 2.0}).point - Vector3d(1.0, 1.0, 0.01)).norm(), 1e-14);
    EXPECT_LT((tree.nearest({0.5, 0.3, 0.009}, {0, 0, -1}).point - Vector3d(0.5, 0.3, 0.0)).norm(), 1e-14);
    EXPECT_THROW(ClosestPointTree(TriMesh{}), Error);
}

}  // namespace
}  // namespace coseg
