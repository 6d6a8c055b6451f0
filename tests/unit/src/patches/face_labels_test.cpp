#include "src/patches/face_labels.hpp"

#include <gtest/gtest.h>

#include "src/base/error.hpp"
#include "tests/support/shapes.hpp"

namespace coseg {
namespace {

/// Faces in a row, consecutive ones sharing an edge of the given length.
DualGraph row_of_faces(const std::vector<double>& lengths) {
    DualGraph graph{
        .face_count = static_cast<int>(lengths.size()) + 1, .edges = {}, .offsets = {0}, .incident = {}};
    for (int f = 0; f < graph.face_count; ++f) {
        if (f > 0) graph.incident.push_back(f - 1);
        if (f + 1 < graph.face_count) {
            graph.edges.push_back({.face_a = f,
                                   .face_b = f + 1,
                                   .vertex_a = f,
                                   .vertex_b = f + 1,
                                   .length = lengths[static_cast<std::size_t>(f)]});
            graph.incident.push_back(f);
        }
        graph.offsets.push_back(static_cast<int>(graph.incident.size()));
    }
    return graph;
}

const std::vector<int> three_patches{0, 1, 2};

TEST(FaceLabels, MajorityWins) {
    const DualGraph graph = row_of_faces({1, 1});
    const auto labels = vote_face_labels({three_patches, three_patches, three_patches},
                                         {{0, 1, 2}, {0, 2, 2}, {3, 1, 2}}, 4, graph);
    EXPECT_EQ(labels, (std::vector<int>{0, 1, 2}));
}

TEST(FaceLabels, OneOversegmentationIsTakenAsItIs) {
    EXPECT_EQ(vote_face_labels({{0, 0, 1}}, {{5, 3}}, 6, row_of_faces({1, 1})), (std::vector<int>{5, 5, 3}));
}

TEST(FaceLabels, TiesGoToTheLongerBoundary) {
    // The middle face ties between 0 and 1; its neighbours are decided as 0 (length 1) and 1 (length 2).
    const std::vector<std::vector<int>> parts{{0, 0, 1}, {0, 1, 1}};
    EXPECT_EQ(vote_face_labels({three_patches, three_patches}, parts, 2, row_of_faces({1, 2})),
              (std::vector<int>{0, 1, 1}));
    EXPECT_EQ(vote_face_labels({three_patches, three_patches}, parts, 2, row_of_faces({2, 1})),
              (std::vector<int>{0, 0, 1}));
    EXPECT_EQ(vote_face_labels({three_patches, three_patches}, parts, 2, row_of_faces({1, 1})),
              (std::vector<int>{0, 0, 1}));
}

TEST(FaceLabels, TiesSpreadFromDecidedFacesRoundByRound) {
    // Only the last face is decided; the others tie between 0 and 1 and are reached one a round.
    const std::vector<std::vector<int>> patches(2, {0, 0, 0, 1});
    EXPECT_EQ(vote_face_labels(patches, {{0, 1}, {1, 1}}, 2, row_of_faces({1, 1, 1})),
              (std::vector<int>{1, 1, 1, 1}));
}

TEST(FaceLabels, NeighboursOutsideTheTieDoNotDecide) {
    const std::vector<std::vector<int>> patches(2, {0, 1});
    EXPECT_EQ(vote_face_labels(patches, {{1, 0}, {2, 0}}, 3, row_of_faces({1})), (std::vector<int>{1, 0}));
}

TEST(FaceLabels, OrderOfFacesDoesNotMatter) {
    const TriMesh mesh = test::torus(1, 0.4, 20, 10);
    std::vector<int> order;
    const TriMesh shuffled = test::shuffled_faces(mesh, 3, order);
    std::vector<std::vector<int>> patches(3), shuffled_patches(3);
    for (int f = 0; f < mesh.face_count(); ++f) {
        for (int o = 0; o < 3; ++o) patches[static_cast<std::size_t>(o)].push_back((f + 13 * o) / 40 % 4);
    }
    for (std::size_t o = 0; o < 3; ++o) {
        for (const int f : order) shuffled_patches[o].push_back(patches[o][static_cast<std::size_t>(f)]);
    }
    const std::vector<std::vector<int>> parts{{0, 1, 2, 3}, {1, 2, 3, 0}, {2, 3, 0, 1}};
    const auto labels = vote_face_labels(patches, parts, 4, dual_graph(mesh, face_geometry(mesh)));
    const auto of_shuffled =
        vote_face_labels(shuffled_patches, parts, 4, dual_graph(shuffled, face_geometry(shuffled)));
    for (std::size_t k = 0; k < order.size(); ++k)
        EXPECT_EQ(of_shuffled[k], labels[static_cast<std::size_t>(order[k])]);
}

TEST(FaceLabels, MissingPartsAreErrors) {
    const DualGraph graph = row_of_faces({1, 1});
    EXPECT_THROW(vote_face_labels({three_patches}, {{0, 1}}, 3, graph), Error);
    EXPECT_THROW(vote_face_labels({three_patches}, {{0, 1, 3}}, 3, graph), Error);
    EXPECT_THROW(vote_face_labels({three_patches}, {{0, 1, -1}}, 3, graph), Error);
    EXPECT_THROW(vote_face_labels({}, {}, 3, graph), Error);
}

}  // namespace
}  // namespace coseg
