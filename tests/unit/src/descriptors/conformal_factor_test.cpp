#include "src/descriptors/conformal_factor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "src/base/error.hpp"
#include "tests/support/awkward_shapes.hpp"
#include "tests/support/generated_shapes.hpp"
#include "tests/support/read_off.hpp"
#include "tests/support/shapes.hpp"

namespace coseg {
namespace {

Eigen::VectorXd factor_of(const TriMesh& mesh) { return conformal_factor(mesh, face_geometry(mesh)); }

/// A surface of revolution about z through rings of the given radii and heights, closed by a point at either
/// end.
TriMesh spindle(const std::vector<double>& radii, const std::vector<double>& heights, int around) {
    const int rings = static_cast<int>(radii.size());
    TriMesh mesh;
    mesh.vertices.resize(3, rings * around + 2);
    mesh.faces.resize(3, 2 * rings * around);
    const int bottom = rings * around, top = bottom + 1;
    mesh.vertices.col(bottom) << 0, 0, 2 * heights.front() - heights[1];
    mesh.vertices.col(top) << 0, 0, 2 * heights.back() - heights[heights.size() - 2];
    int f = 0;
    for (int i = 0; i < rings; ++i) {
        for (int j = 0; j < around; ++j) {
            const double turn = 2 * std::numbers::pi * j / around;
            const int a = i * around + j, b = i * around + (j + 1) % around;
            const auto r = static_cast<std::size_t>(i);
            mesh.vertices.col(a) << radii[r] * std::cos(turn), radii[r] * std::sin(turn), heights[r];
            if (i == 0) mesh.faces.col(f++) << bottom, b, a;
            if (i + 1 == rings) mesh.faces.col(f++) << top, a, b;
            if (i + 1 == rings) continue;
            mesh.faces.col(f++) << a, b, b + around;
            mesh.faces.col(f++) << a, b + around, a + around;
        }
    }
    return mesh;
}

TEST(ConformalFactor, OfASphereIsZero) {
    const Eigen::VectorXd factor = factor_of(test::sphere(4, 2.0));
    EXPECT_LT(factor.cwiseAbs().maxCoeff(), 0.01);
}

/// phi of the spheroid (sin u, -length cos u) at u = pi i / steps. With arc length s and radius rho, L phi =
/// K_target - K integrated from the pole is rho phi' = 1 - rho' - 2 A(s) / A_total.
std::vector<double> spheroid_factor(double length, int steps) {
    const double step = std::numbers::pi / steps;
    const auto speed = [&](double u) { return std::hypot(std::cos(u), length * std::sin(u)); };
    std::vector<double> area{0.0};  // over 2 pi, at u = i step / 2
    for (int i = 0; i < 2 * steps; ++i) {
        const double u = (i + 0.5) * step / 2;
        area.push_back(area.back() + step / 2 * std::sin(u) * speed(u));
    }
    const auto slope = [&](int i) {  // d phi / d u at i step / 2
        const double u = i * step / 2;
        return (1.0 - std::cos(u) / speed(u) - 2.0 * area[static_cast<std::size_t>(i)] / area.back()) *
               speed(u) / std::sin(u);
    };
    std::vector<double> factor{0.0};
    for (int i = 0; i < steps; ++i) factor.push_back(factor.back() + step * slope(2 * i + 1));
    return factor;
}

TEST(ConformalFactor, OfASpheroidIsKnown) {
    const double length = 3.0;
    const int steps = 400, around = 96;
    std::vector<double> radii, heights;
    for (int i = 1; i < steps; ++i) {
        radii.push_back(std::sin(std::numbers::pi * i / steps));
        heights.push_back(-length * std::cos(std::numbers::pi * i / steps));
    }
    const TriMesh mesh = spindle(radii, heights, around);
    const Eigen::VectorXd factor = factor_of(mesh);
    const std::vector<double> exact = spheroid_factor(length, steps);
    EXPECT_GT(exact[200] - exact[40], 1.0);  // the ends are to shrink
    for (int f = 0; f < mesh.face_count(); f += 97) {
        double expected = 0.0;
        bool at_pole = false;
        for (int k = 0; k < 3; ++k) {
            const auto ring = static_cast<std::size_t>(mesh.faces(k, f) / around);
            // Where the rings are wider than they are apart.
            at_pole = at_pole || ring < 5 || ring + 5 > radii.size();
            expected += exact[ring + 1] / 3.0 - exact[200] / 3.0;
        }
        if (!at_pole) {
            EXPECT_NEAR(factor[f] - factor[2 * 200 * around], expected, 0.02) << f;
        }
    }
}

TEST(ConformalFactor, HasAreaMeanZeroOnEveryComponent) {
    const TriMesh mesh = test::disjoint_union(test::limbed_body(3), test::torus(2, 0.5, 24, 12));
    const FaceGeometry geometry = face_geometry(mesh);
    const Eigen::VectorXd factor = conformal_factor(mesh, geometry);
    const int first = test::limbed_body(3).face_count();
    EXPECT_NEAR(geometry.area.head(first).dot(factor.head(first)), 0.0, 1e-9);
    EXPECT_NEAR(geometry.area.dot(factor), 0.0, 1e-9);
}

TEST(ConformalFactor, IsLowestAtTheTipOfALimb) {
    const TriMesh mesh = test::limbed_body(4);
    const FaceGeometry geometry = face_geometry(mesh);
    const Eigen::VectorXd factor = conformal_factor(mesh, geometry);
    int lowest = 0, tip = 0;
    factor.minCoeff(&lowest);
    geometry.centroid.row(0).maxCoeff(&tip);
    EXPECT_LT((geometry.centroid.col(lowest) - geometry.centroid.col(tip)).norm(), 0.3);
    EXPECT_LT(factor[lowest], -1.0);
    EXPECT_GT(factor.maxCoeff(), 0.0);
}

TEST(ConformalFactor, AComponentDoesNotKnowOfTheOthers) {
    const TriMesh alone = test::limbed_body(3);
    const Eigen::VectorXd expected = factor_of(alone);
    const Eigen::VectorXd factor = factor_of(test::disjoint_union(test::box(1, 2, 3, 5), alone));
    EXPECT_LT((factor.tail(alone.face_count()) - expected).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(ConformalFactor, ScaleRotationAndOrderDoNotMatter) {
    TriMesh mesh = test::jittered(test::limbed_body(3), 0.1);
    scale_to_unit_area(mesh);
    const Eigen::VectorXd expected = factor_of(mesh);
    for (const double scale : {1e-8, 1e-3, 1e8}) {
        TriMesh other = test::moved(mesh, 1.1);
        other.vertices *= scale;
        scale_to_unit_area(other);
        EXPECT_NEAR((factor_of(other) - expected).cwiseAbs().maxCoeff(), 0.0, 1e-8);
    }
    std::vector<int> order;
    const Eigen::VectorXd found = factor_of(test::shuffled_faces(mesh, 3, order));
    for (std::size_t k = 0; k < order.size(); ++k) {
        EXPECT_NEAR(found[static_cast<Eigen::Index>(k)], expected[order[k]], 1e-8);
    }
}

TEST(ConformalFactor, AwkwardMeshesGiveFiniteModestValues) {
    for (const auto& [name, mesh] : test::awkward_meshes()) {
        const Eigen::VectorXd factor = factor_of(mesh);
        ASSERT_EQ(factor.size(), mesh.face_count()) << name;
        EXPECT_TRUE(factor.allFinite()) << name;
        EXPECT_LT(factor.cwiseAbs().maxCoeff(), 100.0) << name;
    }
}

TEST(ConformalFactor, ASystemTooStiffToSolveFallsBackToEqualWeights) {
    // A limb thinned to 1e-5 of its length: the cotangent system leaves a residual of 1e-5, its phi would be
    // above 1e4.
    TriMesh mesh = test::limbed_body(4);
    mesh.vertices.bottomRows(2) *= 1e-5;
    const Eigen::VectorXd factor = factor_of(mesh);
    EXPECT_TRUE(factor.allFinite());
    EXPECT_LT(factor.cwiseAbs().maxCoeff(), 100.0);
}

TEST(ConformalFactor, CoordinatesThatAreNotNumbersAreRefused) {
    TriMesh mesh = test::sphere(1);
    mesh.vertices(0, 0) = std::nan("");
    try {
        factor_of(mesh);
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::internal);
        EXPECT_NE(std::string(error.what()).find("80 faces"), std::string::npos) << error.what();
    }
}

void expect_finite_of_area_mean_zero(TriMesh mesh, const std::string& name) {
    scale_to_unit_area(mesh);
    const FaceGeometry geometry = face_geometry(mesh);
    const Eigen::VectorXd factor = conformal_factor(mesh, geometry);
    EXPECT_TRUE(factor.allFinite()) << name;
    EXPECT_NEAR(geometry.area.dot(factor), 0.0, 1e-8) << name;
    EXPECT_LT(factor.cwiseAbs().maxCoeff(), 100.0) << name;
}

TEST(ConformalFactor, GeneratedMeshesGiveFiniteValuesOfAreaMeanZero) {
    for (const auto& [name, shape] : test::generated_shapes())
        expect_finite_of_area_mean_zero(shape.mesh, name);
}

TEST(ConformalFactor, RealMeshesGiveFiniteValuesOfAreaMeanZero) {
    const auto meshes = test::various_meshes();
    if (meshes.empty()) GTEST_SKIP() << "set COSEG_DATA to the folder with the labelled sets";
    for (const auto& [name, mesh] : meshes) expect_finite_of_area_mean_zero(mesh, name);
}

}  // namespace
}  // namespace coseg
