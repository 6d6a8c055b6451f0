#include "src/repair/outlying_vertices.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "src/repair/mesh_repair.hpp"
#include "tests/support/manifold.hpp"
#include "tests/support/shapes.hpp"

namespace coseg {
namespace {

int outliers_of(const TriMesh& mesh) {
    WorkingTriangles working;
    std::vector<Eigen::Vector3d> positions;
    for (int v = 0; v < mesh.vertex_count(); ++v) positions.emplace_back(mesh.vertices.col(v));
    for (int f = 0; f < mesh.face_count(); ++f) {
        working.triangles.emplace_back(mesh.faces.col(f));
        working.input_face.push_back(f);
    }
    const int count = remove_outlying(working, positions);
    EXPECT_EQ(count == 0, working.triangles.size() == static_cast<std::size_t>(mesh.face_count()));
    EXPECT_EQ(working.triangles.size(), working.input_face.size());
    return count;
}

TEST(OutlyingVertices, ASpikeIsLeftOutAndItsFacesTakeTheLabelOfNeighbours) {
    const TriMesh sphere = test::sphere(3);
    for (const double reach : {50.0, 300.0, 17000.0, 1e12}) {
        PolygonMesh spiked = test::as_polygons(sphere);
        spiked.vertices[100] *= reach;
        const RepairedMesh repaired = repair(spiked, "spiked");
        const auto at_spike = (sphere.faces.array() == 100).cast<int>().sum();
        EXPECT_EQ(repaired.mesh.face_count(), sphere.face_count() - at_spike) << reach;
        EXPECT_LE(repaired.mesh.vertices.colwise().norm().maxCoeff(), 1.0 + 1e-9);
        ASSERT_EQ(repaired.warnings.size(), 1U);
        EXPECT_NE(repaired.warnings[0].find("1 vertex lies far away"), std::string::npos);
        for (int f = 0; f < sphere.face_count(); ++f) {
            const bool is_lost = (sphere.faces.col(f).array() == 100).any();
            const int donor = repaired.map.label_donor[static_cast<std::size_t>(f)];
            EXPECT_EQ(donor != f, is_lost);
            // The donor shares the two corners of the lost face that are no spike.
            int shared = 0;
            for (const int v : sphere.faces.col(donor))
                shared += (sphere.faces.col(f).array() == v).any() ? 1 : 0;
            EXPECT_GE(shared, 2);
        }
    }
}

TEST(OutlyingVertices, AStraySliverIsLeftOut) {
    TriMesh sliver;
    sliver.vertices.resize(3, 3);
    sliver.vertices << 2.0, 102.0, 52.0, 0.0, 0.0, 1e-4, 0.0, 0.0, 0.0;
    sliver.faces.resize(3, 1);
    sliver.faces << 0, 1, 2;
    EXPECT_EQ(outliers_of(test::disjoint_union(test::sphere(3), sliver)), 2);
    EXPECT_EQ(outliers_of(test::disjoint_union(test::box(1, 1, 1, 1), sliver)),
              0);  // it is half of the shape
}

TEST(OutlyingVertices, LongLimbsStay) {
    EXPECT_EQ(outliers_of(test::sphere(3)), 0);
    EXPECT_EQ(outliers_of(test::prism(0.5, 1e4, 64)), 0);
    // A ball on a long pole, whose far end is a ring of short edges.
    EXPECT_EQ(outliers_of(test::disjoint_union(test::sphere(4), test::prism(0.01, 100.0, 8))), 0);
    // A drawn cone: many triangles meet at its tip.
    TriMesh cone = test::prism(1.0, 1.0, 200);
    for (int i = 200; i < 400; ++i)
        cone.faces = cone.faces.unaryExpr([&](int v) { return v == i ? 200 : v; });
    cone.vertices.col(200) << 0.0, 0.0, 100.0;
    EXPECT_EQ(outliers_of(cone), 0);
}

TEST(OutlyingVertices, ExtremeCoordinatesAreRepairedLikeOthers) {
    const TriMesh box = test::box(1.0, 2.0, 3.0, 3);
    for (const double scale : {1e-300, 1e-30, 1e30, 1e150, 1e300}) {
        PolygonMesh extreme = test::as_polygons(box);
        for (Eigen::Vector3d& p : extreme.vertices) p *= scale;
        const RepairedMesh repaired = repair(extreme, "box");
        EXPECT_TRUE(repaired.warnings.empty()) << scale;
        EXPECT_EQ(repaired.mesh.faces, box.faces);
        EXPECT_TRUE(repaired.mesh.vertices.colwise().squaredNorm().allFinite());
        EXPECT_GT(repaired.mesh.vertices.colwise().squaredNorm().maxCoeff(), 0.0);
    }
}

}  // namespace
}  // namespace coseg
