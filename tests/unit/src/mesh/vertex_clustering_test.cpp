#include "src/mesh/vertex_clustering.hpp"

#include <gtest/gtest.h>

#include "tests/support/shapes.hpp"

namespace coseg {
namespace {

TEST(VertexClustering, KeepsASmallMeshAsItIs) {
    const TriMesh mesh = test::sphere(2);
    const ClusteredMesh same = clustered(mesh, mesh.face_count());
    EXPECT_EQ(same.mesh.faces, mesh.faces);
    EXPECT_EQ(same.triangle.back(), mesh.face_count() - 1);
}

TEST(VertexClustering, AFineSphereStaysASphereOfFewerFaces) {
    const TriMesh mesh = test::sphere(5);
    const ClusteredMesh coarse = clustered(mesh, 2000);
    EXPECT_LE(coarse.mesh.face_count(), 2000);
    EXPECT_GT(coarse.mesh.face_count(), 1200);
    for (const auto& point : coarse.mesh.vertices.colwise()) EXPECT_NEAR(point.norm(), 1.0, 0.02);
    for (int f = 0; f < coarse.mesh.face_count(); ++f) {
        const int from = coarse.triangle[static_cast<std::size_t>(f)];
        const Eigen::Vector3d middle = coarse.mesh.vertices.col(coarse.mesh.faces(0, f));
        EXPECT_LT((middle - mesh.vertices.col(mesh.faces(0, from))).norm(), 0.3);
    }
}

}  // namespace
}  // namespace coseg
