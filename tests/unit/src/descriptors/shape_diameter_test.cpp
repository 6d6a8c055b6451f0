#include "src/descriptors/shape_diameter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "src/descriptors/inside_rays.hpp"
#include "tests/support/awkward_shapes.hpp"
#include "tests/support/generated_shapes.hpp"
#include "tests/support/read_off.hpp"
#include "tests/support/shapes.hpp"

namespace coseg {
namespace {

Eigen::VectorXd raw(const TriMesh& mesh) { return shape_diameter_raw(mesh, face_geometry(mesh)); }

Eigen::VectorXd diameter(const TriMesh& mesh) {
    const FaceGeometry geometry = face_geometry(mesh);
    return shape_diameter(mesh, geometry, dual_graph(mesh, geometry));
}

/// The weighted mean of the definition when a ray at an angle to the inward normal has the given length.
double mean_of_cone(const std::function<double(double)>& length_at) {
    const Eigen::VectorXd angles = shape_diameter_cone().angles;
    std::vector<double> lengths;
    for (const double angle : angles) lengths.push_back(length_at(angle));
    std::vector<double> sorted = lengths;
    std::sort(sorted.begin(), sorted.end());
    const double median = (sorted[14] + sorted[15]) / 2;
    double mean = 0.0, square = 0.0;
    for (const double x : lengths) mean += x / 30;
    for (const double x : lengths) square += x * x / 30;
    const double deviation = std::sqrt(square - mean * mean);
    double sum = 0.0, weight = 0.0;
    for (std::size_t i = 0; i < lengths.size(); ++i) {
        if (std::abs(lengths[i] - median) > deviation) continue;
        sum += lengths[i] / angles[static_cast<Eigen::Index>(i)];
        weight += 1.0 / angles[static_cast<Eigen::Index>(i)];
    }
    return sum / weight;
}

TEST(InsideRays, ABoxIsLeftWhereGeometrySays) {
    const TriMesh mesh = test::box(2, 4, 6, 5);
    const InsideRays rays(mesh);
    Eigen::Matrix3Xd directions(3, 7);
    directions << 1, -1, 0, 0, 0, 0, std::sqrt(0.5), 0, 0, 1, -1, 0, 0, std::sqrt(0.5), 0, 0, 0, 0, 1, -1, 0;
    std::vector<double> distance(7);
    rays.cast({0.5, 1.5, 2.5}, directions, distance);
    const std::vector<double> expected{1.5, 0.5, 2.5, 1.5, 3.5, 2.5, 1.5 * std::sqrt(2.0)};
    for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(distance[i], expected[i], 1e-5) << i;
}

TEST(InsideRays, ARayThatMeetsAnOutsideFirstWasNotInside) {
    TriMesh inner = test::box(1, 1, 1, 2);
    inner.vertices.colwise() += Eigen::Vector3d(2, 2, 2);
    const InsideRays rays(test::disjoint_union(test::box(5, 5, 5, 2), inner));
    Eigen::Matrix3Xd directions(3, 3);
    directions << 1, 0, -1, 0, 1, 0, 0, 0, 0;
    std::vector<double> distance(3);
    rays.cast({0.5, 2.4, 2.3}, directions, distance);
    EXPECT_EQ(distance[0], 0.0);  // enters the inner box
    EXPECT_NEAR(distance[1], 2.6, 1e-5);
    EXPECT_NEAR(distance[2], 0.5, 1e-5);
}

TEST(InsideRays, ATouchingComponentIsNotAnObstacle) {
    for (const bool other_first : {false, true}) {
        const TriMesh leg = test::box(1, 1, 3, 4);
        TriMesh seat = test::box(1, 1, 1, 4);
        seat.vertices.row(2).array() += 3.0;  // its underside is the leg's top
        const InsideRays rays(other_first ? test::disjoint_union(seat, leg)
                                          : test::disjoint_union(leg, seat));
        Eigen::Matrix3Xd directions(3, 2);
        directions << 0, 0.6, 0, 0, 1, 0.8;
        std::vector<double> distance(2);
        rays.cast({0.11, 0.37, 2.4}, directions, distance);
        EXPECT_NEAR(distance[0], 0.6, 1e-5);
        EXPECT_NEAR(distance[1], 0.75, 1e-5);
    }
}

TEST(InsideRays, NothingIsMetThroughAnOpening) {
    const InsideRays rays(test::flat_square(3));
    Eigen::Matrix3Xd directions(3, 2);
    directions << 0, 0, 0, 0, 1, -1;
    std::vector<double> distance{-1.0, -1.0};
    rays.cast({0.4, 0.45, -1.0}, directions, distance);  // from behind, towards it and away
    EXPECT_NEAR(distance[0], 1.0, 1e-6);
    EXPECT_EQ(distance[1], 0.0);
    rays.cast({0.4, 0.45, 1.0}, directions, distance);  // from the front
    EXPECT_EQ(distance[0], 0.0);
    EXPECT_EQ(distance[1], 0.0);
}

TEST(ShapeDiameter, TheConeIsSixtyDegreesWideAndThreefold) {
    const RayCone cone = shape_diameter_cone();
    ASSERT_EQ(cone.directions.cols(), shape_diameter_rays);
    EXPECT_GT(cone.angles.minCoeff(), 0.1);
    EXPECT_LT(cone.angles.maxCoeff(), std::numbers::pi / 3);
    EXPECT_GT(cone.angles.maxCoeff(), std::numbers::pi / 3 * 0.95);
    EXPECT_LT((cone.directions.colwise().norm().array() - 1.0).abs().maxCoeff(), 1e-12);
    for (int r = 0; r < shape_diameter_rays; ++r) {
        EXPECT_NEAR(std::acos(cone.directions(2, r)), cone.angles[r], 1e-12);
    }
    const Eigen::Vector3d sum = cone.directions.rowwise().sum();
    EXPECT_NEAR(sum.head<2>().norm(), 0.0, 1e-12);
}

TEST(ShapeDiameter, OfASlabIsItsThickness) {
    const double thickness = 0.05;
    const TriMesh mesh = test::box(1, 1, thickness, 21);
    const FaceGeometry geometry = face_geometry(mesh);
    const Eigen::VectorXd found = shape_diameter_raw(mesh, geometry);
    const double expected = thickness * mean_of_cone([](double angle) { return 1.0 / std::cos(angle); });
    EXPECT_NEAR(expected / thickness, 1.3, 0.03);
    const Eigen::Matrix3Xd normals = face_normals(mesh);
    int in_middle = 0;
    for (int f = 0; f < mesh.face_count(); ++f) {
        const Eigen::Vector3d c = geometry.centroid.col(f);
        const bool middle = (c.head<2>() - Eigen::Vector2d(0.5, 0.5)).cwiseAbs().maxCoeff() < 0.35;
        if (!middle || std::abs(normals(2, f)) < 0.5) continue;
        EXPECT_NEAR(found[f], expected, 1e-4 * expected) << f;
        ++in_middle;
    }
    EXPECT_GT(in_middle, 400);
}

TEST(ShapeDiameter, OfASphereIsTheMeanChord) {
    const double radius = 3.0;
    const TriMesh mesh = test::sphere(4, radius);
    const Eigen::VectorXd found = raw(mesh);
    const double expected = 2 * radius * mean_of_cone([](double angle) { return std::cos(angle); });
    EXPECT_NEAR(found.minCoeff() / expected, 1.0, 0.02);
    EXPECT_NEAR(found.maxCoeff() / expected, 1.0, 0.02);
}

TEST(ShapeDiameter, IsLowOnAThinPlateAndHighOnABody) {
    TriMesh plate = test::box(2, 2, 0.1, 20);
    plate.vertices.colwise() += Eigen::Vector3d(3, 0, 0);
    const TriMesh mesh = test::disjoint_union(test::box(2, 2, 2, 12), plate);
    const FaceGeometry geometry = face_geometry(mesh);
    const Eigen::VectorXd found = diameter(mesh);
    EXPECT_EQ(found.minCoeff(), 0.0);
    EXPECT_EQ(found.maxCoeff(), 1.0);
    for (int f = 0; f < mesh.face_count(); ++f) {
        const Eigen::Vector3d c = geometry.centroid.col(f);
        const bool on_plate = (c.head<2>() - Eigen::Vector2d(4, 1)).cwiseAbs().maxCoeff() < 0.6;
        const bool on_body = (c - Eigen::Vector3d(1, 1, 1)).cwiseAbs().sum() < 1.8;  // near a side's middle
        if (on_plate) {
            EXPECT_LT(found[f], 0.1) << f;
        }
        if (on_body) {
            EXPECT_GT(found[f], 0.7) << f;
        }
    }
}

TEST(ShapeDiameter, RawScalesWithTheMesh) {
    const TriMesh mesh = test::limbed_body(3);
    const Eigen::VectorXd expected = raw(mesh);
    for (const double scale : {1e-8, 1e8}) {
        TriMesh other = mesh;
        other.vertices *= scale;
        EXPECT_LT((raw(other) / scale - expected).cwiseAbs().maxCoeff(), 1e-3 * expected.maxCoeff());
    }
}

/// Rounding moves a ray across a silhouette, or past the one-deviation limit, now and then: most faces must
/// agree to single precision, all of them roughly.
void expect_same(const Eigen::VectorXd& found, const Eigen::VectorXd& expected) {
    const Eigen::ArrayXd difference = (found - expected).cwiseAbs().array();
    EXPECT_LE((difference > 1e-5).count(), expected.size() / 200);
    EXPECT_LT(difference.maxCoeff(), 0.05);
}

TEST(ShapeDiameter, ScaleRotationAndOrderDoNotMatter) {
    TriMesh mesh = test::jittered(test::limbed_body(3), 0.1);
    scale_to_unit_area(mesh);
    const Eigen::VectorXd expected = diameter(mesh);
    for (const double scale : {1e-8, 1e-3, 1e8}) {
        TriMesh other = test::moved(mesh, 1.1);
        other.vertices *= scale;
        scale_to_unit_area(other);
        expect_same(diameter(other), expected);
    }
    std::vector<int> order;
    const TriMesh shuffled = test::shuffled_faces(mesh, 3, order);
    const Eigen::VectorXd found = diameter(shuffled);
    Eigen::VectorXd in_new_order(expected.size());
    for (std::size_t k = 0; k < order.size(); ++k)
        in_new_order[static_cast<Eigen::Index>(k)] = expected[order[k]];
    expect_same(found, in_new_order);
}

TEST(ShapeDiameter, EquilateralFacesDoNotKnowTheirFirstCorner) {
    const TriMesh mesh = test::sphere(0);
    TriMesh turned = mesh;
    turned.faces.row(0) = mesh.faces.row(1);
    turned.faces.row(1) = mesh.faces.row(2);
    turned.faces.row(2) = mesh.faces.row(0);
    EXPECT_LT((raw(turned) - raw(mesh)).cwiseAbs().maxCoeff(), 1e-5);
}

TEST(ShapeDiameter, TwiceTheSameCallGivesTheSameBytes) {
    const TriMesh mesh = test::limbed_body(3);
    EXPECT_EQ(diameter(mesh), diameter(mesh));
}

TEST(ShapeDiameter, OpenFacesTakeTheirNeighboursValue) {
    // The square meets nothing. It stands by the large sphere, so the virtual edge gives it that one's
    // thickness.
    TriMesh small = test::sphere(2, 0.5);
    small.vertices.row(0).array() += 9.0;
    TriMesh square = test::flat_square(3);
    square.vertices.row(0).array() -= 4.0;
    const TriMesh mesh = test::disjoint_union(test::disjoint_union(test::sphere(2, 2.0), small), square);
    EXPECT_EQ(raw(mesh).tail(square.face_count()).maxCoeff(), 0.0);
    EXPECT_GT(raw(mesh).head(mesh.face_count() - square.face_count()).minCoeff(), 0.0);
    const Eigen::VectorXd found = diameter(mesh);
    EXPECT_GT(found.tail(square.face_count()).minCoeff(), 0.9);
    EXPECT_LT(found.segment(mesh.face_count() - square.face_count() - small.face_count(), small.face_count())
                  .maxCoeff(),
              0.1);
    EXPECT_EQ(found.minCoeff(), 0.0);
    EXPECT_EQ(found.maxCoeff(), 1.0);
}

TEST(ShapeDiameter, ABoxWithoutItsLidKeepsValuesEverywhere) {
    TriMesh mesh = test::box(1, 1, 0.2, 10);
    const Eigen::Matrix3Xd normals = face_normals(mesh);
    std::vector<int> kept;
    for (int f = 0; f < mesh.face_count(); ++f) {
        if (normals(2, f) < 0.5) kept.push_back(f);
    }
    mesh.faces = Eigen::Matrix3Xi(mesh.faces(Eigen::all, kept));
    const Eigen::VectorXd thickness = raw(mesh);
    EXPECT_GT((thickness.array() == 0.0).count(), 20);  // the floor's rays leave through the opening
    EXPECT_GT((thickness.array() > 0.0).count(), 20);
    const Eigen::VectorXd found = diameter(mesh);
    EXPECT_TRUE(found.allFinite());
    EXPECT_EQ(found.minCoeff(), 0.0);
    EXPECT_EQ(found.maxCoeff(), 1.0);
}

TEST(ShapeDiameter, TheSameThicknessEverywhereIsZero) {
    EXPECT_EQ(diameter(test::sphere(0)).cwiseAbs().maxCoeff(), 0.0);
}

TEST(ShapeDiameter, AwkwardMeshesGiveValuesInRange) {
    for (const auto& [name, mesh] : test::awkward_meshes()) {
        const Eigen::VectorXd found = diameter(mesh);
        ASSERT_EQ(found.size(), mesh.face_count()) << name;
        EXPECT_TRUE(found.allFinite()) << name;
        EXPECT_GE(found.minCoeff(), 0.0) << name;
        EXPECT_LE(found.maxCoeff(), 1.0) << name;
    }
}

/// The mesh is closed, so that hardly a ray may leave it.
void expect_closed_mesh_in_range(TriMesh mesh, const std::string& name) {
    scale_to_unit_area(mesh);
    const Eigen::VectorXd thickness = raw(mesh);
    EXPECT_TRUE(thickness.allFinite()) << name;
    EXPECT_LT((thickness.array() == 0.0).count(), mesh.face_count() / 100) << name;
    const Eigen::VectorXd found = diameter(mesh);
    EXPECT_EQ(found.minCoeff(), 0.0) << name;
    EXPECT_EQ(found.maxCoeff(), 1.0) << name;
}

TEST(ShapeDiameter, GeneratedMeshesGiveValuesInRange) {
    for (const auto& [name, shape] : test::generated_shapes()) expect_closed_mesh_in_range(shape.mesh, name);
}

TEST(ShapeDiameter, RealMeshesGiveValuesInRange) {
    const auto folder = test::data_folder();
    if (folder.empty()) GTEST_SKIP() << "set COSEG_DATA to the folder with the labelled sets";
    for (const char* set : {"psb_airplane", "coseg_chairs", "humans_adobe"}) {
        const auto files = test::off_files(folder / set);
        for (std::size_t i = 0; i < files.size(); i += 20)
            expect_closed_mesh_in_range(test::read_off(files[i]), files[i]);
    }
}

/// The caps are fans of slivers whose boxes all overlap. Above some 1,000 sides rays are cast from a part of
/// the faces only, and the others take the mean of their neighbours'.
TEST(ShapeDiameter, TangledBoxesCostRaysAndHardlyChangeValues) {
    const auto without_value = [](const Eigen::VectorXd& thickness) {
        return (thickness.array() == 0.0).count();
    };
    const TriMesh plain = test::prism(1.0, 1.0, 300);
    const TriMesh tangled = test::prism(1.0, 1.0, 2400);
    EXPECT_EQ(without_value(raw(plain)), 0);
    EXPECT_GT(without_value(raw(tangled)), tangled.face_count() / 2);
    const Eigen::VectorXd expected = diameter(plain);
    const Eigen::VectorXd found = diameter(tangled);
    EXPECT_NEAR(found.mean(), expected.mean(), 0.1);
    EXPECT_LT((found.array() == 0.0).count(), tangled.face_count() / 100);
}

}  // namespace
}  // namespace coseg
