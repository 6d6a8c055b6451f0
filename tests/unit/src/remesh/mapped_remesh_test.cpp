#include "src/remesh/mapped_remesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "src/base/error.hpp"
#include "src/mesh/face_geometry.hpp"
#include "tests/support/face_maps.hpp"
#include "tests/support/read_off.hpp"
#include "tests/support/real_meshes.hpp"
#include "tests/support/shapes.hpp"
#include "tests/support/surface_checks.hpp"

namespace coseg {
namespace {

TEST(MappedRemesh, BoxOfTwelveTrianglesKeepsItsSidesAndTheWayBack) {
    const TriMesh box = test::box(1.0, 0.2, 0.3, 1);
    ASSERT_EQ(box.face_count(), 12);
    TriMesh mesh = box;
    FaceMap map = test::identity_map(12);
    remesh_evenly(mesh, map, 3000);
    EXPECT_TRUE(test::is_closed_and_oriented(mesh));
    EXPECT_NEAR(test::volume(mesh), 0.06, 1e-9);  // creases do not move
    EXPECT_GT(mesh.face_count(), 2000);
    ASSERT_EQ(map.input_face.size(), static_cast<std::size_t>(mesh.face_count()));

    // Labelled by side, every triangle of the box gets the label of its own side back.
    const Eigen::Matrix3Xd normals = face_normals(mesh);
    const auto side = [](const Eigen::Vector3d& normal) {
        Eigen::Index axis = 0;
        normal.cwiseAbs().maxCoeff(&axis);
        return static_cast<int>(2 * axis + (normal[axis] > 0.0 ? 1 : 0));
    };
    std::vector<int> labels;
    for (int f = 0; f < mesh.face_count(); ++f) labels.push_back(side(normals.col(f)));
    const std::vector<int> carried = carry_labels_back(map, labels, face_geometry(mesh).area);
    const Eigen::Matrix3Xd of_box = face_normals(box);
    ASSERT_EQ(carried.size(), 12U);
    for (int f = 0; f < 12; ++f) EXPECT_EQ(carried[static_cast<std::size_t>(f)], side(of_box.col(f)));
}

TEST(MappedRemesh, FacesWithoutANewTriangleTakeTheNearestLabel) {
    TriMesh mesh = test::sphere(5);  // 20480 faces on 500
    const FaceGeometry input = face_geometry(mesh);
    FaceMap map = test::identity_map(mesh.face_count());
    remesh_evenly(mesh, map, 500);
    EXPECT_LT(mesh.face_count(), 3000);
    const FaceGeometry geometry = face_geometry(mesh);
    std::vector<int> labels;
    for (int f = 0; f < mesh.face_count(); ++f) labels.push_back(geometry.centroid(2, f) > 0.0 ? 1 : 0);
    const std::vector<int> carried = carry_labels_back(map, labels, face_geometry(mesh).area);
    double right = 0.0;
    for (Eigen::Index f = 0; f < input.area.size(); ++f) {
        if (carried[static_cast<std::size_t>(f)] == (input.centroid(2, f) > 0.0 ? 1 : 0))
            right += input.area[f];
    }
    EXPECT_GT(right, 0.93 * input.total_area);
}

TEST(MappedRemesh, ARodKeepsToTheBudgetOrStaysAsItIs) {
    for (const double height : {10.0, 100.0, 1e4, 1e6, 1e9}) {
        const TriMesh rod = test::prism(0.5, height, 16);
        TriMesh mesh = rod;
        FaceMap map = test::identity_map(rod.face_count());
        if (height > 1e3) {
            EXPECT_THROW(remesh_evenly(mesh, map, 3000), Error) << height;
            EXPECT_EQ(mesh.faces, rod.faces);
            EXPECT_EQ(map.input_face, test::identity_map(rod.face_count()).input_face);
        } else {
            remesh_evenly(mesh, map, 3000);
            EXPECT_GT(mesh.face_count(), 2000) << height;
            EXPECT_LE(mesh.face_count(), 15000) << height;
            EXPECT_TRUE(test::is_closed_and_oriented(mesh));
            EXPECT_NEAR(test::volume(mesh), test::volume(rod), 0.1 * test::volume(rod));
        }
    }
}

TEST(MappedRemesh, AVertexOfThousandsOfTrianglesIsRefused) {
    TriMesh mesh = test::prism(1.0, 1.0, 5000);  // two fans of 4,998 triangles
    FaceMap map = test::identity_map(mesh.face_count());
    EXPECT_THROW(remesh_evenly(mesh, map, 20000), Error);
    EXPECT_EQ(mesh.face_count(), 4 * 5000 - 4);
}

TEST(MappedRemesh, ACrumpledVaseKeepsToTheBudget) {
    const std::vector<std::string> paths = test::real_meshes();
    const auto vase = std::find_if(paths.begin(), paths.end(), [](const std::string& path) {
        return path.ends_with("large_vases/0291.off");
    });
    if (vase == paths.end()) GTEST_SKIP() << "coseg_large_vases/0291.off is not here; set COSEG_DATA";
    TriMesh mesh = test::read_off(*vase);
    FaceMap map = test::identity_map(mesh.face_count());
    ASSERT_EQ(mesh.face_count(), 1000);
    remesh_evenly(mesh, map, 3000);  // round by round its triangles became more, up to 101,606
    EXPECT_GT(mesh.face_count(), 3000);
    EXPECT_LE(mesh.face_count(), 6000);
}

TEST(MappedRemesh, RefusesAMeshWithoutArea) {
    TriMesh mesh = test::sphere(0);
    mesh.vertices.setZero();
    FaceMap map = test::identity_map(mesh.face_count());
    EXPECT_THROW(remesh_evenly(mesh, map, 100), Error);
}

}  // namespace
}  // namespace coseg
