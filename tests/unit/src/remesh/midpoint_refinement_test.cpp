#include "src/remesh/midpoint_refinement.hpp"

#include <gtest/gtest.h>

#include "src/mesh/face_geometry.hpp"
#include "src/repair/mesh_repair.hpp"
#include "tests/support/face_maps.hpp"
#include "tests/support/manifold.hpp"
#include "tests/support/shapes.hpp"

namespace coseg {
namespace {

void expect_refined(const TriMesh& coarse, int minimum) {
    TriMesh mesh = coarse;
    FaceMap map = test::identity_map(coarse.face_count());
    refine_to_face_count(mesh, map, minimum);
    EXPECT_GE(mesh.face_count(), minimum);
    EXPECT_LE(mesh.face_count(), minimum + 1);
    EXPECT_EQ(test::manifold_defect(mesh), "");
    EXPECT_EQ(test::boundary_edges(coarse) == 0, test::boundary_edges(mesh) == 0);
    EXPECT_NEAR(test::signed_volume(mesh), test::signed_volume(coarse), 1e-12);
    ASSERT_EQ(static_cast<int>(map.input_face.size()), mesh.face_count());
    const FaceGeometry before = face_geometry(coarse);
    const FaceGeometry after = face_geometry(mesh);
    const Eigen::Matrix3Xd normals_before = face_normals(coarse);
    const Eigen::Matrix3Xd normals_after = face_normals(mesh);
    Eigen::VectorXd share = Eigen::VectorXd::Zero(coarse.face_count());
    for (int f = 0; f < mesh.face_count(); ++f) {
        const int from = map.input_face[static_cast<std::size_t>(f)];
        share[from] += after.area[f];
        EXPECT_NEAR(normals_after.col(f).dot(normals_before.col(from)), 1.0, 1e-9);
    }
    EXPECT_LT((share - before.area).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(MidpointRefinement, AreaMapAndManifoldArePreserved) {
    expect_refined(test::box(1, 1, 1, 1), 100);
    expect_refined(test::box(1, 1, 1, 1), 101);
    expect_refined(test::box(5, 0.2, 1, 1), 500);
    expect_refined(test::sphere(0), 1500);
    expect_refined(test::torus(1, 0.3, 6, 4), 777);
    expect_refined(test::flat_square(1), 64);
    expect_refined(test::disjoint_union(test::box(1, 1, 1, 1), test::sphere(0)), 300);
}

TEST(MidpointRefinement, TwoFacesBackToBack) {
    const PolygonMesh pillow = test::polygons_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}});
    RepairedMesh repaired = repair(pillow, "pillow");
    refine_to_face_count(repaired.mesh, repaired.map, 50);
    EXPECT_EQ(repaired.mesh.face_count(), 50);
    EXPECT_EQ(test::manifold_defect(repaired.mesh), "");
}

TEST(MidpointRefinement, TrianglesBecomeEven) {
    TriMesh mesh = test::box(8, 1, 1, 1);
    FaceMap map = test::identity_map(mesh.face_count());
    refine_to_face_count(mesh, map, 1000);
    const FaceGeometry geometry = face_geometry(mesh);
    EXPECT_LT(geometry.area.maxCoeff(), 10 * geometry.area.minCoeff());
    for (int f = 0; f < mesh.face_count(); ++f) {
        double longest = 0.0;
        for (int k = 0; k < 3; ++k) {
            longest = std::max(
                longest,
                (mesh.vertices.col(mesh.faces(k, f)) - mesh.vertices.col(mesh.faces((k + 1) % 3, f))).norm());
        }
        EXPECT_GT(2 * geometry.area[f] / longest, 0.12 * longest);  // the box begins with 8 / 65
    }
}

TEST(MidpointRefinement, EndsWhereDoublesHaveNoMiddle) {
    TriMesh mesh = test::box(1, 1, 1, 1);
    mesh.vertices *= 8.0;
    mesh.vertices.array() += 0x1p54;  // neighbouring doubles differ by 4 there
    FaceMap map = test::identity_map(mesh.face_count());
    refine_to_face_count(mesh, map, 10000);
    EXPECT_GT(mesh.face_count(), 12);
    EXPECT_LT(mesh.face_count(), 200);
    EXPECT_EQ(static_cast<int>(map.input_face.size()), mesh.face_count());
    EXPECT_EQ(test::manifold_defect(mesh), "");
}

TEST(MidpointRefinement, FineMeshesStayAsTheyAre) {
    TriMesh mesh = test::sphere(2);
    FaceMap map = test::identity_map(mesh.face_count());
    refine_to_face_count(mesh, map, mesh.face_count());
    EXPECT_EQ(mesh.faces, test::sphere(2).faces);
    EXPECT_EQ(map.input_face, test::identity_map(mesh.face_count()).input_face);
}

TEST(MidpointRefinement, LabelsComeBackThroughRepairAndRefinement) {
    const PolygonMesh cube = test::polygons_of(
        {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}},
        {{3, 2, 1, 0}, {4, 5, 6, 7}, {0, 1, 1}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}});
    RepairedMesh repaired = repair(cube, "cube");
    refine_to_face_count(repaired.mesh, repaired.map, 400);
    const FaceGeometry geometry = face_geometry(repaired.mesh);
    std::vector<int> labels;
    for (int f = 0; f < repaired.mesh.face_count(); ++f)
        labels.push_back(geometry.centroid(2, f) > 0.4 ? 1 : 0);
    const std::vector<int> back = carry_labels_back(repaired.map, labels, geometry.area);
    EXPECT_EQ(back[0], 0);
    EXPECT_EQ(back[1], 1);
    EXPECT_EQ(back[3], 1);
    EXPECT_EQ(back[2], back[static_cast<std::size_t>(repaired.map.label_donor[2])]);
}

}  // namespace
}  // namespace coseg
