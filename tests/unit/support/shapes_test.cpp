#include "tests/support/shapes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "src/mesh/dual_graph.hpp"
#include "src/mesh/face_geometry.hpp"

namespace coseg {
namespace {

TEST(DualGraph, ClosedMeshHasThreeEdgesForTwoFaces) {
    for (const TriMesh& mesh : {test::sphere(3), test::box(1, 2, 3, 6), test::torus(1, 0.3, 24, 12)}) {
        const DualGraph graph = dual_graph(mesh, face_geometry(mesh));
        EXPECT_EQ(static_cast<int>(graph.edges.size()) * 2, mesh.face_count() * 3);
        EXPECT_EQ(mesh.face_count(), graph.face_count);
    }
}

TEST(DualGraph, BoxEdgesAreConvexRightAnglesOrFlat) {
    const TriMesh mesh = test::box(1, 1, 1, 3);
    for (const DualEdge& edge : dual_graph(mesh, face_geometry(mesh)).edges) {
        const bool flat = std::abs(edge.dihedral - std::numbers::pi) < 1e-12;
        const bool convex = std::abs(edge.dihedral - 1.5 * std::numbers::pi) < 1e-12;
        EXPECT_TRUE(flat || convex) << edge.dihedral;
    }
}

TEST(FaceGeometry, SphereAreaApproachesFourPi) {
    EXPECT_NEAR(face_geometry(test::sphere(4)).total_area, 4 * std::numbers::pi, 0.02);
}

TEST(FaceGeometry, UnitAreaAndCentred) {
    TriMesh mesh = test::box(3, 1, 2, 8);
    mesh.vertices.colwise() += Eigen::Vector3d(5, -7, 9);
    scale_to_unit_area(mesh);
    const FaceGeometry geometry = face_geometry(mesh);
    EXPECT_NEAR(geometry.total_area, 1.0, 1e-12);
    EXPECT_NEAR((geometry.centroid * geometry.area).norm(), 0.0, 1e-12);
}

}  // namespace
}  // namespace coseg
