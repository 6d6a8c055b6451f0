#include "io/mesh_files/obj_format.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "src/base/index.hpp"
#include "src/mesh/face_triangles.hpp"
#include "tests/support/errors.hpp"
#include "tests/support/tetrahedron.hpp"

namespace coseg {
namespace {

using test::expect_tetrahedron;

const std::string obj_points = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
const std::string obj_faces = "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

TEST(ObjFormat, LinesGoOnBehindABackslash) {
    for (const std::string end :
         {"\\\n", " \\\n", " \\ \n", "\\ \t\n", " \\\r\n", " \\ \r\n", " \\\n \\\n "}) {
        SCOPED_TRACE(end);
        const std::string joined =
            "f 1 3" + end + "2\nf" + end + "1 2 4\nf 1 4 3" + end + "\nf 2" + end + "3" + end + "4\n";
        expect_tetrahedron(read_obj(obj_points + joined, "a.obj"));
        expect_tetrahedron(read_obj("v 0" + end + "0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n" + obj_faces, "a.obj"));
    }
}

TEST(ObjFormat, WeightsAndColoursBehindCoordinates) {
    for (const std::string behind : {" 1", " 0.5", " 255 0 0", " 0.1 0.2 0.3 1"}) {
        std::string vertices;
        for (const char* point : {"0 0 0", "1 0 0", "0 1 0", "0 0 1"})
            vertices.append("v ").append(point).append(behind).append("\n");
        expect_tetrahedron(read_obj(vertices + obj_faces, "a.obj"));
    }
}

TEST(ObjFormat, CornersInEveryForm) {
    expect_tetrahedron(read_obj("\xEF\xBB\xBF# made by hand\n" + obj_points +
                                    "vn 0 0 1\nvt 0 0\ng one two\nusemtl red\ns 1\nf 1//1 3//1 2//1\no "
                                    "thing\nf -4 -3 -1\nl 1 2\nf 1/1 4/1 3/1\nfo 2/1/1 3/1/1 4/1/1\n",
                                "a.obj"));
}

TEST(ObjFormat, CapitalsAndWholeNumbersWithAPoint) {
    expect_tetrahedron(read_obj(
        "O A\nV 0 0 0\nV 1 0 0\nV 0 1 0\nV 0 0 1\nVN 0 0 1\nF 1 3 2\nF 1 2 4\nF 1 4 3\nF 2 3 4\n", "a.obj"));
    expect_tetrahedron(
        read_obj(obj_points + "f 1.0 3.0 2.0\nf 1 2 4\nf 1.0/1 4e0/1 3./1\nf 2 3 4\n", "a.obj"));
}

TEST(ObjFormat, VerticesThatNoFaceUsesNeedNoNumbers) {
    const ParsedMesh parsed = read_obj(
        "v nan 0 0\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 -nan(ind) 0\nf 2 4 3\nf 2 3 "
        "5\nf 2 5 4\nf 3 4 5\n",
        "a.obj");
    expect_tetrahedron({parsed.mesh, {}});
    ASSERT_EQ(parsed.warnings.size(), 1U);
    EXPECT_TRUE(parsed.warnings[0].starts_with("a.obj: 2 vertices"));
    const test::Caught used =
        test::error_of([] { read_obj("v 0 0 0\n\nv nan 0 0\nv 0 1 0\nf 1 2 3\n", "a.obj"); });
    EXPECT_TRUE(used.sentence.starts_with("a.obj:3: vertex 1 has a coordinate that is not a finite number"))
        << used.sentence;
}

TEST(ObjFormat, TextWithoutVerticesAndFacesIsNoObj) {
    const test::Caught caught = test::error_of([] { read_obj("\n404: Not Found\n", "a.obj"); });
    EXPECT_TRUE(caught.sentence.starts_with("a.obj:2: no line begins with 'v' or 'f'")) << caught.sentence;
}

TEST(ObjFormat, FacesOfNoCornersKeepTheirPlace) {
    EXPECT_EQ(read_obj(obj_points + "f\nf 1 2 3\nf # none\n", "a.obj").mesh.offsets,
              (std::vector<int>{0, 0, 3, 3}));
}

TEST(ObjFormat, VerticesNamedTwiceInARowCountOnce) {
    const auto corners = [](const std::string& face) {
        return read_obj(obj_points + face, "a.obj").mesh.corners;
    };
    for (const std::string face : {"f 1 2 2 3\n", "f 1 1 2 3 1\n", "f 1 2 3 3 3 1 1\n"})
        EXPECT_EQ(corners(face), (std::vector<int>{0, 1, 2})) << face;
    EXPECT_EQ(corners("f 1 2 2\n"), (std::vector<int>{0, 1, 1}));
    EXPECT_EQ(corners("f 1 1 1\n"), (std::vector<int>{0, 0, 0}));
}

TEST(ObjFormat, AFaceMayLeadAroundAHole) {
    // A square of 4 x 4 with a hole of 2 x 2, which a cut from vertex 1 to vertex 5 joins to the outside.
    const PolygonMesh mesh = read_obj(
                                 "v -2 -2 0\nv 2 -2 0\nv 2 2 0\nv -2 2 0\nv -1 -1 0\nv -1 1 0\nv 1 1 "
                                 "0\nv 1 -1 0\nf 1 2 3 4 1 5 6 7 8 5\n",
                                 "a.obj")
                                 .mesh;
    EXPECT_EQ(mesh.corners, (std::vector<int>{0, 1, 2, 3, 0, 4, 5, 6, 7, 4}));
    double area = 0.0;
    for (const FaceTriangle& triangle : face_triangles(mesh)) {
        const auto corner = [&](std::size_t k) { return mesh.vertices[at(triangle.vertices[k])]; };
        const double part = 0.5 * (corner(1) - corner(0)).cross(corner(2) - corner(0)).z();
        EXPECT_GE(part, 0.0);
        area += part;
    }
    EXPECT_DOUBLE_EQ(area, 12.0);
}

}  // namespace
}  // namespace coseg
