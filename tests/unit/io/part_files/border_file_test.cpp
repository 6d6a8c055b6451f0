#include "io/part_files/border_file.hpp"

#include <gtest/gtest.h>

#include "io/files/file_contents.hpp"
#include "tests/support/temporary_folder.hpp"

namespace coseg {
namespace {

/// A square of which three corners are one closed curve, and an open curve that shares a corner with it.
struct TwoCurves {
    TriMesh mesh;
    std::vector<BorderCurve> curves;
    TwoCurves() {
        mesh.vertices.resize(3, 5);
        mesh.vertices << 0, 1, 1, 0, 0.1, 0, 0, 1, 1, 0, 9, 9, 9, 9, 9;
        BorderCurve triangle;
        triangle.part_a = 0;
        triangle.part_b = 2;
        triangle.is_closed = true;
        triangle.vertices = {1, 2, 4};
        BorderCurve open;
        open.part_a = 1;
        open.part_b = 2;
        open.is_closed = false;
        open.vertices = {2, 0};
        curves = {triangle, open};
    }
};

TEST(BorderFile, LinesOfObjShareVertices) {
    const test::TemporaryFolder folder;
    const TwoCurves made;
    write_border_lines(folder.path() + "/a.obj", made.mesh, made.curves, {"seat", "leg", "back"});
    EXPECT_EQ(read_file(folder.path() + "/a.obj"),
              "# coseg: the curves between parts\nv 1 0 9\nv 1 1 9\nv 0.1 0 9\nv 0 0 9\n"
              "o seat | back\nl 1 2 3 1\no leg | back\nl 2 4\n");
}

TEST(BorderFile, LinesOfVtpHaveTheirParts) {
    const test::TemporaryFolder folder;
    const TwoCurves made;
    write_border_vtp(folder.path() + "/a.vtp", made.mesh, made.curves);
    const std::string text = read_file(folder.path() + "/a.vtp");
    const auto array = [&](const std::string& name) {
        const std::size_t begin = text.find('\n', text.find("Name=\"" + name + "\"")) + 1;
        return text.substr(begin, text.find('\n', begin) - begin);
    };
    EXPECT_NE(text.find("NumberOfPoints=\"4\" NumberOfVerts=\"0\" NumberOfLines=\"2\""), std::string::npos);
    EXPECT_EQ(array("points"), " 1 0 9 1 1 9 0.1 0 9 0 0 9");
    EXPECT_EQ(array("connectivity"), " 0 1 2 0 1 3");
    EXPECT_EQ(array("offsets"), " 4 6");
    EXPECT_EQ(array("part_a"), " 0 1");
    EXPECT_EQ(array("part_b"), " 2 2");
    EXPECT_EQ(array("closed"), " 1 0");
}

}  // namespace
}  // namespace coseg
