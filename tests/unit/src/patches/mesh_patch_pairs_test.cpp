#include "src/patches/mesh_patch_pairs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <utility>

#include "src/mesh/connected_pieces.hpp"
#include "tests/support/shapes.hpp"

namespace coseg {
namespace {

/// A unit square whose faces are labelled by a rule on their centroids.
struct Square {
    TriMesh mesh = test::flat_square(8);
    FaceGeometry geometry = face_geometry(mesh);
    DualGraph graph = dual_graph(mesh, geometry);

    template <typename Rule>
    [[nodiscard]] std::vector<int> labels(const Rule& rule) const {
        std::vector<int> label;
        for (int f = 0; f < mesh.face_count(); ++f)
            label.push_back(rule(geometry.centroid(0, f), geometry.centroid(1, f)));
        return label;
    }
};

TEST(PatchRelations, HalvesOfASquareShareOneSideAndItsMeanConcavity) {
    const Square s;
    const std::vector<int> halves = s.labels([](double x, double) { return x < 0.5 ? 0 : 1; });
    const Eigen::VectorXd curvature = s.mesh.vertices.row(1).transpose();  // y, mean .5 along the boundary
    const auto pairs = patch_neighbors(s.graph, halves, curvature);
    ASSERT_EQ(pairs.size(), 1U);
    EXPECT_EQ(pairs[0].patch_a, 0);
    EXPECT_EQ(pairs[0].patch_b, 1);
    EXPECT_NEAR(pairs[0].boundary_length, 1.0, 1e-12);
    EXPECT_NEAR(pairs[0].concavity, 0.5, 1e-12);
}

TEST(PatchRelations, ConcavityIsWeightedByLength) {
    // A strip of three triangles: patches {0}, {1, 2} share one edge; {0, 2}, {1} share two of unequal
    // length.
    TriMesh mesh;
    mesh.vertices.resize(3, 5);
    mesh.vertices << 0, 1, 1, 0, 5, 0, 0, 1, 1, 0.5, 0, 0, 0, 0, 0;
    mesh.faces.resize(3, 3);
    mesh.faces << 0, 0, 1, 1, 2, 4, 2, 3, 2;
    const FaceGeometry geometry = face_geometry(mesh);
    const DualGraph graph = dual_graph(mesh, geometry);
    Eigen::VectorXd curvature(5);
    curvature << 1.0, 0.5, 0.0, 0.25, 0.75;
    const auto pairs = patch_neighbors(graph, {1, 0, 0}, curvature);
    ASSERT_EQ(pairs.size(), 1U);
    const double diagonal = std::numbers::sqrt2;
    EXPECT_NEAR(pairs[0].boundary_length, 1.0 + diagonal, 1e-12);
    EXPECT_NEAR(pairs[0].concavity, (1.0 * 0.25 + diagonal * 0.5) / (1.0 + diagonal), 1e-12);
}

TEST(PatchRelations, NeighboursAreSortedAndCornersDoNotTouch) {
    const Square s;
    const std::vector<int> quarters =
        s.labels([](double x, double y) { return (x < 0.5 ? 3 : 1) - (y < 0.5 ? 0 : 1); });
    const auto pairs = patch_neighbors(s.graph, quarters, Eigen::VectorXd::Zero(s.mesh.vertex_count()));
    ASSERT_EQ(pairs.size(), 4U);
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        EXPECT_LT(pairs[k].patch_a, pairs[k].patch_b);
        if (k > 0) {
            EXPECT_LT(std::pair(pairs[k - 1].patch_a, pairs[k - 1].patch_b),
                      std::pair(pairs[k].patch_a, pairs[k].patch_b));
        }
        EXPECT_NEAR(pairs[k].boundary_length, 0.5, 1e-12);
        EXPECT_EQ(pairs[k].concavity, 0.0);
    }
}

TEST(PatchRelations, VirtualEdgesCountAsSmoothBoundary) {
    const Square s;
    DualGraph graph{.face_count = 2,
                    .edges = {{.face_a = 0, .face_b = 1, .length = 0.125, .dihedral = std::numbers::pi}},
                    .offsets = {0, 1, 2},
                    .incident = {0, 0}};
    const auto pairs = patch_neighbors(graph, {0, 1}, Eigen::VectorXd::Ones(3));
    ASSERT_EQ(pairs.size(), 1U);
    EXPECT_EQ(pairs[0].boundary_length, 0.125);
    EXPECT_EQ(pairs[0].concavity, 0.0);
}

TEST(PatchRelations, OverlapsAreIntersectionOverUnion) {
    const Square s;
    const std::vector<int> columns = s.labels([](double x, double) { return x < 0.5 ? 0 : 1; });
    const std::vector<int> rows = s.labels([](double, double y) { return y < 0.25 ? 0 : 1; });
    const auto overlaps = patch_overlaps(s.geometry, columns, rows);
    ASSERT_EQ(overlaps.size(), 4U);
    for (const PatchOverlap& o : overlaps) {
        const double common = o.patch_b == 0 ? 0.125 : 0.375;
        const double all = 0.5 + (o.patch_b == 0 ? 0.25 : 0.75) - common;
        EXPECT_NEAR(o.intersection_over_union, common / all, 1e-12);
    }
    const auto with_itself = patch_overlaps(s.geometry, columns, columns);
    ASSERT_EQ(with_itself.size(), 2U);
    for (const PatchOverlap& o : with_itself) {
        EXPECT_EQ(o.patch_a, o.patch_b);
        EXPECT_NEAR(o.intersection_over_union, 1.0, 1e-12);
    }
}

TEST(PatchRelations, AreasAddUp) {
    const Square s;
    const std::vector<int> thirds =
        s.labels([](double x, double) { return x < 0.25 ? 0 : (x < 0.75 ? 1 : 3); });
    const Eigen::VectorXd area = patch_areas(s.geometry, thirds, 4);
    EXPECT_NEAR(area[0], 0.25, 1e-12);
    EXPECT_NEAR(area[1], 0.5, 1e-12);
    EXPECT_EQ(area[2], 0.0);
    EXPECT_NEAR(area[3], 0.25, 1e-12);
}

TEST(ConnectedPieces, ChessboardFieldsOfASquareStayApart) {
    const Square s;
    const std::vector<int> board =
        s.labels([](double x, double y) { return (x < 0.5) == (y < 0.5) ? 0 : 1; });
    const std::vector<int> pieces = connected_pieces(s.graph, board);
    EXPECT_EQ(*std::max_element(pieces.begin(), pieces.end()), 3);
    EXPECT_EQ(pieces[0], 0);
}

TEST(ConnectedPieces, VirtualEdgesConnectUnlessIgnored) {
    const DualGraph graph{
        .face_count = 2, .edges = {{.face_a = 0, .face_b = 1}}, .offsets = {0, 1, 2}, .incident = {0, 0}};
    EXPECT_EQ(connected_pieces(graph, {4, 4}), (std::vector<int>{0, 0}));
    EXPECT_EQ(connected_pieces(graph, {4, 4}, VirtualEdges::ignored), (std::vector<int>{0, 1}));
}

}  // namespace
}  // namespace coseg
