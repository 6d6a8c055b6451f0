#include "src/descriptors/minimum_curvature.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/awkward_shapes.hpp"
#include "tests/support/generated_shapes.hpp"
#include "tests/support/read_off.hpp"
#include "tests/support/shapes.hpp"

namespace coseg {
namespace {

TEST(MinimumCurvature, OfASphereIsOneOverRadiusBothWays) {
    for (const double radius : {0.5, 3.0}) {
        const TriMesh mesh = test::sphere(4, radius);
        const PrincipalCurvatures curvature = principal_curvatures(mesh, face_geometry(mesh));
        for (int v = 0; v < mesh.vertex_count(); ++v) {
            EXPECT_NEAR(curvature.minimum[v] * radius, 1.0, 0.06) << v;
            EXPECT_NEAR(curvature.maximum[v] * radius, 1.0, 0.06) << v;
        }
    }
}

TEST(MinimumCurvature, OfATorusFollowsTheClosedForm) {
    const double major = 1.0, minor = 0.4;
    const TriMesh mesh = test::torus(major, minor, 120, 48);
    const PrincipalCurvatures curvature = principal_curvatures(mesh, face_geometry(mesh));
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        const double from_axis = mesh.vertices.col(v).head<2>().norm();
        // cos(v) / (R + r cos(v)); the other is 1 / r.
        const double across = (from_axis - major) / minor / from_axis;
        EXPECT_NEAR(curvature.minimum[v], across, 0.12) << v;
        EXPECT_NEAR(curvature.maximum[v], 1.0 / minor, 0.12) << v;
    }
}

TEST(MinimumCurvature, OfASaddleHasBothSigns) {
    // z = a (x^2 - y^2) has curvatures -2a and 2a at the origin.
    const double a = 0.7;
    TriMesh mesh = test::flat_square(60);
    mesh.vertices.colwise() -= Eigen::Vector3d(0.5, 0.5, 0.0);
    mesh.vertices.row(2) = a * (mesh.vertices.row(0).cwiseAbs2() - mesh.vertices.row(1).cwiseAbs2());
    const PrincipalCurvatures curvature = principal_curvatures(mesh, face_geometry(mesh));
    const int centre = 30 * 61 + 30;
    EXPECT_NEAR(mesh.vertices.col(centre).norm(), 0.0, 1e-12);
    EXPECT_NEAR(curvature.minimum[centre], -2 * a, 0.05);
    EXPECT_NEAR(curvature.maximum[centre], 2 * a, 0.05);
}

TEST(MinimumCurvature, OfAPlaneIsZeroAndFlippingTurnsTheSign) {
    const TriMesh plane = test::flat_square(6);
    EXPECT_EQ(principal_curvatures(plane, face_geometry(plane)).minimum.cwiseAbs().maxCoeff(), 0.0);

    const TriMesh mesh = test::limbed_body(3);
    TriMesh inside_out = mesh;
    inside_out.faces.row(1).swap(inside_out.faces.row(2));
    const PrincipalCurvatures out = principal_curvatures(mesh, face_geometry(mesh));
    const PrincipalCurvatures in = principal_curvatures(inside_out, face_geometry(inside_out));
    EXPECT_LT((out.minimum + in.maximum).cwiseAbs().maxCoeff(), 1e-9 * out.maximum.cwiseAbs().maxCoeff());
}

TEST(MinimumCurvature, ConvexShapesHaveNoConcavity) {
    for (const TriMesh& mesh : {test::sphere(3), test::box(1, 2, 3, 8)}) {
        EXPECT_LT(minimum_curvature(mesh, face_geometry(mesh)).maxCoeff(), 1e-9);
    }
}

TEST(MinimumCurvature, ConcavityLiesAtTheRootOfALimb) {
    const TriMesh mesh = test::limbed_body(4);
    const Eigen::VectorXd concavity = minimum_curvature(mesh, face_geometry(mesh));
    EXPECT_GE(concavity.minCoeff(), 0.0);
    EXPECT_EQ(concavity.maxCoeff(), 1.0);
    int tip = 0;
    mesh.vertices.row(0).maxCoeff(&tip);
    EXPECT_EQ(concavity[tip], 0.0);
    double root = 0.0;  // the ring where the limb leaves the body
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        const Eigen::Vector3d p = mesh.vertices.col(v);
        if (p.x() > 0.9 && p.x() < 1.2) root = std::max(root, concavity[v]);
    }
    EXPECT_EQ(root, 1.0);
    EXPECT_NEAR((concavity.array() == 1.0).cast<double>().mean(), 0.05, 0.005);
}

TEST(MinimumCurvature, ScaleRotationAndOrderDoNotMatter) {
    TriMesh mesh = test::jittered(test::limbed_body(3), 0.1);
    scale_to_unit_area(mesh);
    const Eigen::VectorXd expected = minimum_curvature(mesh, face_geometry(mesh));
    for (const double scale : {1e-8, 1e-3, 1e8}) {
        TriMesh other = test::moved(mesh, 1.1);
        other.vertices *= scale;
        EXPECT_LT((minimum_curvature(other, face_geometry(other)) - expected).cwiseAbs().maxCoeff(), 1e-9);
        scale_to_unit_area(other);
        EXPECT_LT((minimum_curvature(other, face_geometry(other)) - expected).cwiseAbs().maxCoeff(), 1e-9);
    }
    std::vector<int> order;
    const TriMesh shuffled = test::shuffled_faces(mesh, 3, order);
    EXPECT_LT((minimum_curvature(shuffled, face_geometry(shuffled)) - expected).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(MinimumCurvature, AwkwardMeshesGiveValuesInRange) {
    for (const auto& [name, mesh] : test::awkward_meshes()) {
        const Eigen::VectorXd concavity = minimum_curvature(mesh, face_geometry(mesh));
        ASSERT_EQ(concavity.size(), mesh.vertex_count()) << name;
        EXPECT_TRUE(concavity.allFinite()) << name;
        EXPECT_GE(concavity.minCoeff(), 0.0) << name;
        EXPECT_LE(concavity.maxCoeff(), 1.0) << name;
    }
}

void expect_values_from_0_to_1(TriMesh mesh, const std::string& name) {
    scale_to_unit_area(mesh);
    const Eigen::VectorXd concavity = minimum_curvature(mesh, face_geometry(mesh));
    EXPECT_TRUE(concavity.allFinite()) << name;
    EXPECT_GE(concavity.minCoeff(), 0.0) << name;
    EXPECT_EQ(concavity.maxCoeff(), 1.0) << name;
}

TEST(MinimumCurvature, GeneratedMeshesGiveValuesInRange) {
    for (const auto& [name, shape] : test::generated_shapes()) expect_values_from_0_to_1(shape.mesh, name);
}

TEST(MinimumCurvature, RealMeshesGiveValuesInRange) {
    const auto meshes = test::various_meshes();
    if (meshes.empty()) GTEST_SKIP() << "set COSEG_DATA to the folder with the labelled sets";
    for (const auto& [name, mesh] : meshes) expect_values_from_0_to_1(mesh, name);
}

}  // namespace
}  // namespace coseg
