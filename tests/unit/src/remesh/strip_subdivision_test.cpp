#include "src/remesh/strip_subdivision.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "src/mesh/face_geometry.hpp"
#include "tests/support/manifold.hpp"
#include "tests/support/shapes.hpp"

namespace coseg {
namespace {

double longest_edge(const TriMesh& mesh) {
    double longest = 0.0;
    for (int f = 0; f < mesh.face_count(); ++f) {
        for (int k = 0; k < 3; ++k) {
            const Eigen::Vector3d edge =
                mesh.vertices.col(mesh.faces(k, f)) - mesh.vertices.col(mesh.faces((k + 1) % 3, f));
            longest = std::max(longest, edge.norm());
        }
    }
    return longest;
}

TEST(StripSubdivision, KeepsSurfaceOrientationAndBoundary) {
    for (const TriMesh& mesh : {test::prism(0.5, 40.0, 16), test::box(5, 0.2, 1, 1), test::flat_square(2)}) {
        const std::optional<TriMesh> cut = cut_into_strips(mesh, 0.3, 100'000);
        ASSERT_TRUE(cut);
        EXPECT_GT(cut->face_count(), 2 * mesh.face_count());
        EXPECT_EQ(test::manifold_defect(*cut), "");
        EXPECT_EQ(test::boundary_edges(mesh) == 0, test::boundary_edges(*cut) == 0);
        EXPECT_NEAR(test::signed_volume(*cut), test::signed_volume(mesh), 1e-9);
        const FaceGeometry geometry = face_geometry(*cut);
        EXPECT_NEAR(geometry.total_area, face_geometry(mesh).total_area, 1e-9);
        EXPECT_GT(geometry.area.minCoeff(), 0.0);
    }
}

TEST(StripSubdivision, ANeedleGivesTwoTrianglesAPiece) {
    TriMesh needle;
    needle.vertices.resize(3, 3);
    needle.vertices << 0.0, 100.0, 100.0, 0.0, 0.0, 0.01, 0.0, 0.0, 0.0;
    needle.faces.resize(3, 1);
    needle.faces << 0, 1, 2;
    const std::optional<TriMesh> cut = cut_into_strips(needle, 1.0, 1000);
    ASSERT_TRUE(cut);
    EXPECT_EQ(cut->face_count(), 100 + 101 + 1 - 2);  // the slope is a little longer than 100
    EXPECT_LT(longest_edge(*cut), 2.0);
    EXPECT_TRUE(cut_into_strips(needle, 1.0, 200));
    EXPECT_FALSE(cut_into_strips(needle, 1.0, 199));
    EXPECT_FALSE(cut_into_strips(needle, 1e-300, 1'000'000));
}

TEST(StripSubdivision, ShortEdgesStay) {
    const TriMesh sphere = test::sphere(1);
    const std::optional<TriMesh> cut = cut_into_strips(sphere, 2.0, sphere.face_count());
    ASSERT_TRUE(cut);
    EXPECT_EQ(cut->vertices, sphere.vertices);
    EXPECT_EQ(cut->face_count(), sphere.face_count());
}

}  // namespace
}  // namespace coseg
