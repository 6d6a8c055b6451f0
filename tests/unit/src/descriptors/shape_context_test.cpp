#include "src/descriptors/shape_context.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "src/base/seeded_random.hpp"
#include "src/mesh/dual_graph.hpp"
#include "tests/support/shapes.hpp"

namespace coseg {
namespace {

/// No symmetry and no flat part, so that no sample lies on the edge between two bins.
TriMesh bumpy_torus() {
    TriMesh mesh = test::torus(1, 0.4, 36, 18);
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        for (int k = 0; k < 3; ++k) {
            mesh.vertices(k, v) += 0.02 * normal_of(hash_words({9, std::uint64_t(v), std::uint64_t(k)}));
        }
    }
    scale_to_unit_area(mesh);
    return mesh;
}

struct Contexts {
    FaceGeometry geometry;
    Eigen::Matrix3Xd normals;
    GeodesicTable table;
};

Contexts described(const TriMesh& mesh, int samples) {
    Contexts d{face_geometry(mesh), face_normals(mesh), {}};
    d.table = geodesic_table(mesh, d.geometry, dual_graph(mesh, d.geometry), samples, 1);
    return d;
}

Eigen::MatrixXf context_of(const TriMesh& mesh, int samples,
                           ShapeContextNormal normal = ShapeContextNormal::both) {
    const Contexts d = described(mesh, samples);
    return shape_context(d.table, d.geometry.centroid, d.normals, normal);
}

void expect_unit_columns(const Eigen::MatrixXf& context) {
    EXPECT_TRUE(context.allFinite());
    EXPECT_GE(context.minCoeff(), 0.0F);
    EXPECT_LT((context.colwise().sum().array() - 1.0F).abs().maxCoeff(), 1e-5F);
}

/// The mean over columns of the mass that lies in different bins.
double mean_difference(const Eigen::MatrixXf& a, const Eigen::MatrixXf& b) {
    return 0.5 * (a - b).cwiseAbs().sum() / static_cast<double>(a.cols());
}

TEST(ShapeContext, HasTheBinsOfTheDefinition) {
    const Contexts d = described(bumpy_torus(), 80);
    const double largest = d.table.distance.maxCoeff();
    for (const auto normal : {ShapeContextNormal::face, ShapeContextNormal::sample}) {
        const Eigen::MatrixXf context = shape_context(d.table, d.geometry.centroid, d.normals, normal);
        Eigen::MatrixXf expected = Eigen::MatrixXf::Zero(shape_context_bins, context.cols());
        for (Eigen::Index f = 0; f < context.cols(); ++f) {
            for (Eigen::Index k = 0; k < d.table.distance.rows(); ++k) {
                const int sample = d.table.sample_face[std::size_t(k)];
                const Eigen::Vector3d towards = d.geometry.centroid.col(sample) - d.geometry.centroid.col(f);
                const Eigen::Vector3d inward = -d.normals.col(
                    normal == ShapeContextNormal::face ? Eigen::Index{f} : Eigen::Index{sample});
                const double cosine = sample == f ? 0.0 : towards.dot(inward) / towards.norm();
                const double angle = sample == f ? 1.5 : std::acos(cosine);
                int radial = 0;
                for (const double edge : {0.05, 0.1, 0.2, 0.4})
                    radial += d.table.distance(k, f) >= edge * largest ? 1 : 0;
                const int bin = radial * 6 + std::min(5, int(angle / std::numbers::pi * 6));
                expected(bin, f) += float(d.table.sample_weight[k]);
            }
        }
        EXPECT_LT(mean_difference(context, expected), 1e-3);
        expect_unit_columns(context);
        const Eigen::MatrixXf both = shape_context(d.table, d.geometry.centroid, d.normals);
        ASSERT_EQ(both.rows(), 2 * shape_context_bins);
        const int first = normal == ShapeContextNormal::face ? 0 : shape_context_bins;
        EXPECT_EQ(Eigen::MatrixXf(2.0F * both.middleRows(first, shape_context_bins)), context);
    }
}

TEST(ShapeContext, SphereHasTheMassOfItsZones) {
    // From any face of a sphere a point at arc phi lies at distance phi and, against the inward normal, at
    // the angle (pi - phi) / 2; the area between two arcs is (cos phi_1 - cos phi_2) / 2.
    const auto zone = [](double from, double to) {
        return 0.5 * (std::cos(from * std::numbers::pi / 180) - std::cos(to * std::numbers::pi / 180));
    };
    const Eigen::VectorXf mean = context_of(test::sphere(4), 300, ShapeContextNormal::face).rowwise().mean();
    EXPECT_NEAR(mean[4 * 6 + 0], zone(120, 180), 0.02);
    EXPECT_NEAR(mean[4 * 6 + 1], zone(72, 120), 0.03);
    EXPECT_NEAR(mean[3 * 6 + 1], zone(60, 72), 0.03);
    EXPECT_NEAR(mean[3 * 6 + 2], zone(36, 60), 0.03);
    EXPECT_NEAR(mean[2 * 6 + 2], zone(18, 36), 0.02);
    for (int radial = 0; radial < 5; ++radial)
        EXPECT_EQ(mean.segment(radial * 6 + 3, 3).sum(), 0.0F) << radial;
}

TEST(ShapeContext, PlaneFallsIntoOneAngleBinHoweverItIsTurned) {
    TriMesh mesh = test::flat_square(16);
    mesh.vertices =
        Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix() * mesh.vertices;
    const Eigen::MatrixXf context = context_of(mesh, 60, ShapeContextNormal::face);
    expect_unit_columns(context);
    for (Eigen::Index f = 0; f < context.cols(); ++f) {
        float in_plane = 0.0F;
        for (int radial = 0; radial < 5; ++radial) in_plane += context(radial * 6 + 2, f);
        EXPECT_NEAR(in_plane, 1.0F, 1e-5F);
    }
}

TEST(ShapeContext, IgnoresPositionTurnAndScale) {
    TriMesh mesh = bumpy_torus();
    const Eigen::MatrixXf before = context_of(mesh, 100);
    mesh.vertices = Eigen::AngleAxisd(1.1, Eigen::Vector3d(3, -1, 2).normalized()).toRotationMatrix() *
                    mesh.vertices * 4.0;
    mesh.vertices.colwise() += Eigen::Vector3d(0.5, -0.3, 0.2);
    EXPECT_LT(mean_difference(before, context_of(mesh, 100)), 1e-3);
}

TEST(ShapeContext, IgnoresTheOrderOfFaces) {
    const TriMesh mesh = bumpy_torus();
    std::vector<int> order;
    const TriMesh shuffled = test::shuffled_faces(mesh, 3, order);
    const Eigen::MatrixXf before = context_of(mesh, 100);
    const Eigen::MatrixXf after = context_of(shuffled, 100);
    Eigen::MatrixXf expected(before.rows(), before.cols());
    for (std::size_t k = 0; k < order.size(); ++k) expected.col(Eigen::Index(k)) = before.col(order[k]);
    EXPECT_LT(mean_difference(expected, after), 1e-3);
}

TEST(ShapeContext, UglyMeshesHaveUnitColumns) {
    TriMesh triangle = test::flat_square(1);
    triangle.faces.conservativeResize(3, 1);
    const Eigen::MatrixXf single = context_of(triangle, 300);
    expect_unit_columns(single);
    EXPECT_NEAR(single(2, 0), 0.5F, 1e-6F);
    TriMesh creased = test::flat_square(6);
    creased.vertices.col(10) = creased.vertices.col(11);
    creased.vertices.col(25) = creased.vertices.col(24);
    expect_unit_columns(context_of(creased, 30));
}

}  // namespace
}  // namespace coseg
