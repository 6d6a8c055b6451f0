#include "src/mesh/moderate_scale.hpp"

#include <gtest/gtest.h>

#include "src/mesh/face_triangles.hpp"
#include "tests/support/manifold.hpp"

namespace coseg {
namespace {

/// A pentagon of the shape of an M, which a fan about any corner but one would leave.
PolygonMesh concave_face(double scale) {
    PolygonMesh mesh =
        test::polygons_of({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 0.5, 0}, {0, 2, 0}}, {{0, 1, 2, 3, 4}});
    for (Eigen::Vector3d& p : mesh.vertices) p *= scale;
    return mesh;
}

TEST(ModerateScale, MostMeshesKeepTheirSize) {
    for (const double scale : {1e-59, 1.0, 1e37, 1e59}) EXPECT_EQ(extreme_exponent(concave_face(scale)), 0);
    EXPECT_EQ(extreme_exponent({}), 0);
    const PolygonMesh mesh = concave_face(1e-200);
    const int exponent = extreme_exponent(mesh);
    const PolygonMesh moderate = scaled_by_power(mesh, -exponent);
    EXPECT_EQ(extreme_exponent(moderate), 0);
    EXPECT_EQ(scaled_by_power(moderate, exponent).vertices, mesh.vertices);
}

TEST(ModerateScale, FacesAreCutAlikeInEverySize) {
    const std::vector<FaceTriangle> expected = face_triangles(concave_face(1.0));
    for (const double scale : {1e-310, 1e-200, 1e-150, 1e37, 1e200}) {
        const std::vector<FaceTriangle> triangles = face_triangles(concave_face(scale));
        ASSERT_EQ(triangles.size(), expected.size());
        for (std::size_t k = 0; k < triangles.size(); ++k)
            EXPECT_EQ(triangles[k].vertices, expected[k].vertices) << scale;
    }
}

}  // namespace
}  // namespace coseg
