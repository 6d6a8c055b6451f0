#include "src/descriptors/gaussian_curvature.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/awkward_shapes.hpp"
#include "tests/support/generated_shapes.hpp"
#include "tests/support/read_off.hpp"
#include "tests/support/shapes.hpp"

namespace coseg {
namespace {

constexpr double pi = std::numbers::pi;

TEST(GaussianCurvature, DefectsSumToTwoPiTimesTheEulerCharacteristic) {
    EXPECT_NEAR(angle_defects(test::sphere(3)).sum(), 4 * pi, 1e-9);
    EXPECT_NEAR(angle_defects(test::box(1, 2, 3, 6)).sum(), 4 * pi, 1e-9);
    EXPECT_NEAR(angle_defects(test::torus(1, 0.3, 30, 15)).sum(), 0.0, 1e-9);
    EXPECT_NEAR(angle_defects(test::disjoint_union(test::sphere(2), test::torus(1, 0.3, 9, 7))).sum(), 4 * pi,
                1e-9);
    EXPECT_NEAR(angle_defects(test::disjoint_union(test::sphere(2), test::box(1, 1, 1, 2))).sum(), 8 * pi,
                1e-9);
    EXPECT_NEAR(angle_defects(test::limbed_body(3)).sum(), 4 * pi, 1e-9);
}

TEST(GaussianCurvature, ABoundaryTurnsOnceAroundADisc) {
    const TriMesh square = test::flat_square(4);
    const Eigen::VectorXd defect = angle_defects(square);
    EXPECT_NEAR(defect.sum(), 2 * pi, 1e-12);
    EXPECT_NEAR(defect[0], pi / 2, 1e-12);  // a corner
    EXPECT_NEAR(defect[1], 0.0, 1e-12);     // along a side
    EXPECT_NEAR(defect[6], 0.0, 1e-12);     // inside
}

TEST(GaussianCurvature, EightCornersOfABoxHoldARightAngleEach) {
    const Eigen::VectorXd defect = angle_defects(test::box(1, 2, 3, 6));
    int corners = 0;
    for (const double d : defect) {
        if (std::abs(d) < 1e-12) continue;
        EXPECT_NEAR(d, pi / 2, 1e-12);
        ++corners;
    }
    EXPECT_EQ(corners, 8);
}

TEST(GaussianCurvature, DegenerateFacesKeepTheSum) {
    for (const auto& [name, mesh] : test::awkward_meshes()) {
        if (name == "faces without area" || name == "coincident corners") {
            EXPECT_NEAR(angle_defects(mesh).sum(), 4 * pi, 1e-9) << name;
        }
    }
}

TEST(GaussianCurvature, OfASphereIsOneOverRadiusSquared) {
    for (const double radius : {0.5, 3.0}) {
        const TriMesh mesh = test::sphere(4, radius);
        const Eigen::VectorXd curvature = gaussian_curvature(mesh, face_geometry(mesh));
        ASSERT_EQ(curvature.size(), mesh.face_count());
        EXPECT_NEAR(curvature.minCoeff() * radius * radius, 1.0, 0.08);
        EXPECT_NEAR(curvature.maxCoeff() * radius * radius, 1.0, 0.08);
        EXPECT_NEAR(curvature.mean() * radius * radius, 1.0, 0.01);
    }
}

TEST(GaussianCurvature, OfATorusChangesSignBetweenRimAndHole) {
    const double major = 1.0, minor = 0.4;
    const TriMesh mesh = test::torus(major, minor, 160, 64);
    const FaceGeometry geometry = face_geometry(mesh);
    const Eigen::VectorXd curvature = gaussian_curvature(mesh, geometry);
    for (int f = 0; f < mesh.face_count(); ++f) {
        const double from_axis = geometry.centroid.col(f).head<2>().norm();
        const double cosine = std::clamp((from_axis - major) / minor, -1.0, 1.0);
        EXPECT_NEAR(curvature[f], cosine / (minor * (major + minor * cosine)), 0.15) << f;
    }
}

TEST(GaussianCurvature, ScaleRotationAndOrderDoNotMatter) {
    TriMesh mesh = test::jittered(test::limbed_body(3), 0.1);
    scale_to_unit_area(mesh);
    const Eigen::VectorXd expected = gaussian_curvature(mesh, face_geometry(mesh));
    const double size = expected.cwiseAbs().maxCoeff();
    for (const double scale : {1e-8, 1e-3, 1e8}) {
        TriMesh other = test::moved(mesh, 1.1);
        other.vertices *= scale;
        scale_to_unit_area(other);
        EXPECT_NEAR((gaussian_curvature(other, face_geometry(other)) - expected).cwiseAbs().maxCoeff() / size,
                    0.0, 1e-9);
    }
    std::vector<int> order;
    const TriMesh shuffled = test::shuffled_faces(mesh, 3, order);
    const Eigen::VectorXd found = gaussian_curvature(shuffled, face_geometry(shuffled));
    for (std::size_t k = 0; k < order.size(); ++k) {
        EXPECT_NEAR(found[static_cast<Eigen::Index>(k)], expected[order[k]], 1e-9 * size);
    }
}

TEST(GaussianCurvature, AwkwardMeshesGiveFiniteValues) {
    for (const auto& [name, mesh] : test::awkward_meshes()) {
        const Eigen::VectorXd curvature = gaussian_curvature(mesh, face_geometry(mesh));
        ASSERT_EQ(curvature.size(), mesh.face_count()) << name;
        EXPECT_TRUE(curvature.allFinite()) << name;
    }
}

void expect_finite_with_a_whole_characteristic(TriMesh mesh, const std::string& name) {
    scale_to_unit_area(mesh);
    EXPECT_TRUE(gaussian_curvature(mesh, face_geometry(mesh)).allFinite()) << name;
    const double characteristic = angle_defects(mesh).sum() / (2 * pi);
    EXPECT_NEAR(characteristic, std::round(characteristic), 1e-6) << name;
}

TEST(GaussianCurvature, GeneratedMeshesGiveFiniteValuesAndWholeEulerCharacteristics) {
    for (const auto& [name, shape] : test::generated_shapes())
        expect_finite_with_a_whole_characteristic(shape.mesh, name);
}

TEST(GaussianCurvature, RealMeshesGiveFiniteValuesAndWholeEulerCharacteristics) {
    const auto meshes = test::various_meshes();
    if (meshes.empty()) GTEST_SKIP() << "set COSEG_DATA to the folder with the labelled sets";
    for (const auto& [name, mesh] : meshes) expect_finite_with_a_whole_characteristic(mesh, name);
}

}  // namespace
}  // namespace coseg
