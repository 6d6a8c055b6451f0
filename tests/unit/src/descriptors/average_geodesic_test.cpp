#include "src/descriptors/average_geodesic.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <utility>
#include <vector>

#include "src/mesh/dual_graph.hpp"
#include "tests/support/shapes.hpp"

namespace coseg {
namespace {

GeodesicTable table_of(const TriMesh& mesh, int samples) {
    const FaceGeometry geometry = face_geometry(mesh);
    return geodesic_table(mesh, geometry, dual_graph(mesh, geometry), samples, 1);
}

TEST(AverageGeodesic, IsTheWeightedMeanAboveItsMinimum) {
    const GeodesicTable table = table_of(test::torus(1, 0.4, 24, 12), 50);
    Eigen::VectorXd expected = table.distance.cast<double>().transpose() * table.sample_weight;
    expected.array() -= expected.minCoeff();
    EXPECT_LT((average_geodesic(table) - expected).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(AverageGeodesic, IsNearlyZeroOnASphere) {
    // The mean distance is pi / 2 everywhere.
    const Eigen::VectorXd average = average_geodesic(table_of(test::sphere(4), 300));
    EXPECT_EQ(average.minCoeff(), 0.0);
    EXPECT_LT(average.maxCoeff(), 0.04);
}

TEST(AverageGeodesic, GrowsTowardsTheEndsOfARod) {
    // On a segment [0, L] the mean distance from x is (x^2 + (L - x)^2) / (2 L): L / 4 in the middle, L / 2
    // at an end.
    const double length = 10.0;
    const TriMesh mesh = test::box(length, 0.3, 0.3, 100);
    const FaceGeometry geometry = face_geometry(mesh);
    const Eigen::VectorXd average = average_geodesic(table_of(mesh, 200));
    for (Eigen::Index f = 0; f < average.size(); ++f) {
        const double x = geometry.centroid(0, f);
        const double truth = (x * x + (length - x) * (length - x)) / (2 * length) - length / 4;
        EXPECT_NEAR(average[f], truth, 0.03 * length) << x;
    }
}

/// A torus without symmetry.
TriMesh uneven_torus() {
    TriMesh mesh = test::torus(1, 0.4, 24, 12);
    for (int v = 0; v < mesh.vertex_count(); ++v)
        mesh.vertices(2, v) += 0.3 * mesh.vertices(0, v) * mesh.vertices(1, v) + 0.2 * mesh.vertices(0, v);
    scale_to_unit_area(mesh);
    return mesh;
}

TEST(AverageGeodesic, ScaleAndRotationDoNotMatter) {
    const TriMesh mesh = uneven_torus();
    const Eigen::VectorXd expected = average_geodesic(table_of(mesh, 1000));
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    for (const double scale : {1e-6, 1.0, 1e6}) {
        TriMesh other = mesh;
        other.vertices = ((scale * turn) * mesh.vertices).eval();
        other.vertices.colwise() += scale * Eigen::Vector3d(3, -1, 2);
        EXPECT_LT((average_geodesic(table_of(other, 1000)) - scale * expected).cwiseAbs().maxCoeff(),
                  1e-5 * scale);
        scale_to_unit_area(other);
        EXPECT_LT((average_geodesic(table_of(other, 1000)) - expected).cwiseAbs().maxCoeff(), 1e-5);
    }
}

TEST(AverageGeodesic, TheOrderOfFacesDoesNotMatter) {
    const TriMesh mesh = uneven_torus();
    std::vector<int> order;
    const TriMesh shuffled = test::shuffled_faces(mesh, 3, order);
    // With every face a sample the mean is the same; with few it differs by what other samples cover.
    for (const auto& [samples, tolerance] : {std::pair(1000, 1e-5), std::pair(100, 0.02)}) {
        const Eigen::VectorXd expected = average_geodesic(table_of(mesh, samples));
        const Eigen::VectorXd average = average_geodesic(table_of(shuffled, samples));
        for (Eigen::Index f = 0; f < average.size(); ++f)
            EXPECT_NEAR(average[f], expected[order[static_cast<std::size_t>(f)]], tolerance);
    }
}

TEST(AverageGeodesic, SingleTriangleIsZero) {
    TriMesh mesh = test::flat_square(1);
    mesh.faces.conservativeResize(3, 1);
    const Eigen::VectorXd average = average_geodesic(table_of(mesh, 300));
    ASSERT_EQ(average.size(), 1);
    EXPECT_EQ(average[0], 0.0);
}

}  // namespace
}  // namespace coseg
