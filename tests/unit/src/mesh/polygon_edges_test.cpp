#include "src/mesh/polygon_edges.hpp"

#include <gtest/gtest.h>

#include "tests/support/manifold.hpp"

namespace coseg {
namespace {

TEST(PolygonEdges, FacesOfCommonEdgesFormPieces) {
    // Two triangles on the edge 0-1, running the same way; a quad that only touches them at vertex 2; a face
    // that touches nothing, unless vertex 9 stands for 3 and 8 for 2.
    const PolygonMesh mesh = test::polygons_of({{0, 0, 0},
                                                {1, 0, 0},
                                                {0, 1, 0},
                                                {0, 2, 0},
                                                {1, 2, 0},
                                                {1, 1, 0},
                                                {0, -1, 0},
                                                {5, 5, 5},
                                                {6, 5, 5},
                                                {5, 6, 5}},
                                               {{0, 1, 2}, {2, 5, 4, 3}, {0, 1, 6}, {7, 8, 9}});
    std::vector<int> vertex_of{0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
    EXPECT_EQ(polygon_pieces(mesh, vertex_of), (std::vector<int>{0, 1, 0, 3}));
    vertex_of[8] = 2;
    vertex_of[9] = 3;
    EXPECT_EQ(polygon_pieces(mesh, vertex_of), (std::vector<int>{0, 1, 0, 1}));
    const PolygonHalfEdges edges = polygon_half_edges(mesh, vertex_of);
    EXPECT_EQ(edges.from[6], 3);
    EXPECT_EQ(edges.to[6], 2);
    EXPECT_EQ(edges.face[6], 1);
    EXPECT_EQ(edges.from[11], 2);
    EXPECT_EQ(edges.to[11], 3);
}

}  // namespace
}  // namespace coseg
