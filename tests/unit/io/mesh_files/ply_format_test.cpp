#include "io/mesh_files/ply_format.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "io/files/byte_cursor.hpp"
#include "io/mesh_files/mesh_reader.hpp"
#include "src/pictures/part_colors.hpp"
#include "tests/support/errors.hpp"
#include "tests/support/manifold.hpp"
#include "tests/support/shapes.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/tetrahedron.hpp"

namespace coseg {
namespace {

using test::TemporaryFolder;

TEST(PlyFormat, ReadsBackWithTheSameFaces) {
    const TemporaryFolder folder;
    const PolygonMesh mesh =
        test::polygons_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0.75}},
                          {{3, 2, 1, 0}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {1, 1}});
    write_colored_ply(folder.path("p.ply"), mesh, {0, 1, 2, 3, 4, 0});
    const PolygonMesh back = read_mesh(folder.path("p.ply"));
    EXPECT_EQ(back.offsets, mesh.offsets);
    EXPECT_EQ(back.corners, mesh.corners);
    EXPECT_EQ(back.vertices, mesh.vertices);
}

TEST(PlyFormat, BytesOfOneTriangle) {
    const TemporaryFolder folder;
    write_colored_ply(folder.path("t.ply"), test::polygons_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}),
                      {1});
    const std::string bytes = test::content_of(folder.path("t.ply"));
    const std::size_t data = bytes.find("end_header\n") + 11;
    ASSERT_EQ(bytes.size(), data + 3 * 12 + 1 + 12 + 3);
    EXPECT_NE(bytes.find("format binary_little_endian 1.0\n"), std::string::npos);
    EXPECT_EQ(bytes.substr(data + 12, 4), std::string("\x00\x00\x80\x3f", 4));  // 1.0f
    EXPECT_EQ(bytes[data + 36], 3);
    EXPECT_EQ(bytes.substr(data + 37, 12), std::string("\0\0\0\0\1\0\0\0\2\0\0\0", 12));
    const Color color = part_color(1);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(static_cast<std::uint8_t>(bytes[data + 49 + k]), color[k]);
}

TEST(PlyFormat, WritesTheConfidenceOfEachFaceBehindItsColour) {
    const TemporaryFolder folder;
    const PolygonMesh mesh =
        test::polygons_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 3, 2}});
    write_colored_ply(folder.path("c.ply"), mesh, {0, 1}, {0.25F, 0.5F});
    const std::string bytes = test::content_of(folder.path("c.ply"));
    EXPECT_NE(bytes.find("property uchar blue\nproperty float confidence\nend_header\n"), std::string::npos);
    float last = 0.0F;
    std::memcpy(&last, bytes.data() + bytes.size() - sizeof last, sizeof last);
    EXPECT_EQ(last, 0.5F);
    EXPECT_EQ(read_mesh(folder.path("c.ply")).corners, mesh.corners) << "readers pass it over";
    EXPECT_THROW(write_colored_ply(folder.path("d.ply"), mesh, {0, 1}, {0.25F}), Error);
}

TEST(PlyFormat, PolygonWithManyCorners) {
    const TemporaryFolder folder;
    std::vector<Eigen::Vector3d> points;
    std::vector<int> face;
    for (int k = 0; k < 300; ++k) {
        points.emplace_back(std::cos(k * 0.02), std::sin(k * 0.02), 0.0);
        face.push_back(k);
    }
    write_colored_ply(folder.path("m.ply"), test::polygons_of(points, {face}), {63});
    EXPECT_EQ(read_mesh(folder.path("m.ply")).corners, face);
}

const std::string tetrahedron_vertices =
    "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
const std::string tetrahedron_points = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";

TEST(PlyFormat, StripsGiveTheirTriangles) {
    const std::string head = "ply\nformat ascii 1.0\n";
    const auto corners = [&](const std::string& strips) {
        return read_ply(head + tetrahedron_vertices +
                            "element tristrips 1\nproperty list int int vertex_indices\nend_header\n" +
                            tetrahedron_points + strips,
                        "a.ply")
            .mesh.corners;
    };
    EXPECT_EQ(corners("8 0 1 2 3 -1 0 1 3"), (std::vector<int>{0, 1, 2, 2, 1, 3, 0, 1, 3}));
    EXPECT_EQ(corners("4 0 2 1 3"), (std::vector<int>{0, 2, 1, 1, 2, 3}));
    EXPECT_EQ(corners("7 -1 0 1 -1 -1 2 3"), std::vector<int>{});
    // One repeated corner turns the next triangles about, as where strips are drawn.
    EXPECT_EQ(corners("6 0 1 2 2 3 0"), (std::vector<int>{0, 1, 2, 3, 2, 0}));
    EXPECT_EQ(corners("7 0 1 2 2 2 3 0"), (std::vector<int>{0, 1, 2, 2, 3, 0}));
    const ParsedMesh both = read_ply(
        head +
            "element tristrips 2\nproperty list int int vertex_index\nelement face 1\nproperty list uchar "
            "int vertex_index\n" +
            tetrahedron_vertices + "end_header\n3 0 2 1 4 0 1 3 2\n3 1 2 3\n" + tetrahedron_points,
        "a.ply");
    EXPECT_EQ(both.mesh.corners, (std::vector<int>{0, 2, 1, 0, 1, 3, 3, 1, 2, 1, 2, 3}));
}

TEST(PlyFormat, WhatNobodyReadsMayBeAnything) {
    test::expect_tetrahedron(read_ply(
        "ply\r\nformat ascii 1.0\r\nobj_info num_cols 512\r\ncomment\r\nelement note 1\r\nproperty "
        "string text\r\nelement face 4\r\nproperty list uint8 float64 texcoord\r\nproperty string "
        "material\r\nproperty list ushort int64 vertex_index\r\nelement vertex 4\r\nproperty list "
        "char string tags\r\nproperty double z\r\nproperty int y\r\nproperty half x\r\nelement last "
        "7\r\nproperty int i\r\nend_header\r\nnone\r\n2 .5 n/a red 3 0 2 1\r\n0 red 3 0 1 3\r\n0 - 3 0 "
        "3 2\r\n0 0 3 1 2 3\r\n0 0 0 0\r\n1 one 0 0 1\r\n2 a b 0 1 0\r\n0 1 0 0\r\n",
        "a.ply"));
}

TEST(PlyFormat, WhatFollowsTheElementsIsLeftOutWithOneWarning) {
    const std::string faces = "element face 4\nproperty list uchar int vertex_index\nend_header\n" +
                              tetrahedron_points + "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
    for (const std::string rest : {"", "\n \n", "0 1 2\n"}) {
        const ParsedMesh parsed =
            read_ply("ply\nformat ascii 1.0\n" + tetrahedron_vertices + faces + rest, "a.ply");
        test::expect_tetrahedron({parsed.mesh, {}});
        EXPECT_EQ(parsed.warnings.size(), rest == "0 1 2\n" ? 1U : 0U);
    }
}

TEST(PlyFormat, FacesOfNoCornersKeepTheirPlace) {
    const PolygonMesh mesh =
        read_ply("ply\nformat ascii 1.0\n" + tetrahedron_vertices +
                     "element face 3\nproperty list uchar int vertex_index\nend_header\n" +
                     tetrahedron_points + "0\n3 0 1 2\n0\n",
                 "a.ply")
            .mesh;
    EXPECT_EQ(mesh.offsets, (std::vector<int>{0, 0, 3, 3}));
}

TEST(PlyFormat, VerticesThatNoFaceUsesNeedNoNumbers) {
    const std::string head =
        "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float "
        "y\nproperty float z\nelement face 4\nproperty list uchar int "
        "vertex_index\nend_header\n";
    const std::string faces = "3 0 2 1\n3 0 1 4\n3 0 4 2\n3 1 2 4\n";
    const ParsedMesh parsed = read_ply(head + "0 0 0\n1 0 0\n0 1 0\nnan 0 0\n0 0 1\n" + faces, "a.ply");
    test::expect_tetrahedron({parsed.mesh, {}});
    EXPECT_EQ(parsed.warnings.size(), 1U);
    const test::Caught used =
        test::error_of([&] { read_ply(head + "0 0 0\n1 0 0\n0 nan 0\n0 0 0\n0 0 1\n" + faces, "a.ply"); });
    EXPECT_TRUE(used.sentence.starts_with("a.ply:12: vertex 2")) << used.sentence;
}

TEST(PlyFormat, SinglePrecisionThatLostDigitsIsWarnedOf) {
    const std::string head = "ply\nformat binary_little_endian 1.0\n" + tetrahedron_vertices +
                             "element face 4\nproperty list uchar int vertex_index\nend_header\n";
    for (const float origin : {0.0F, 4.5e6F}) {
        std::string bytes = head;
        for (const auto& point :
             {std::array{0, 0, 0}, std::array{1, 0, 0}, std::array{0, 1, 0}, std::array{0, 0, 1}}) {
            for (const int value : point) append_little_endian(bytes, origin + static_cast<float>(value));
        }
        for (const auto& face :
             {std::array{0, 2, 1}, std::array{0, 1, 3}, std::array{0, 3, 2}, std::array{1, 2, 3}}) {
            append_little_endian(bytes, std::uint8_t{3});
            for (const int corner : face) append_little_endian(bytes, corner);
        }
        const ParsedMesh parsed = read_ply(bytes, "a.ply");
        EXPECT_EQ(parsed.mesh.face_count(), 4);
        EXPECT_EQ(parsed.warnings.size(), origin > 0.0F ? 1U : 0U);
    }
}

TEST(PlyFormat, CoordinatesThatNeedDoublesAreWrittenSo) {
    const TemporaryFolder folder;
    PolygonMesh mesh = test::as_polygons(test::sphere(1));
    for (Eigen::Vector3d& p : mesh.vertices) p += Eigen::Vector3d(5e5, 4.5e6, 0);
    write_colored_ply(folder.path("m.ply"), mesh, std::vector<int>(80, 0));
    EXPECT_EQ(read_mesh(folder.path("m.ply")).vertices, mesh.vertices);
}

TEST(PlyFormat, WrongNumberOfLabelsIsRefused) {
    const TemporaryFolder folder;
    const PolygonMesh mesh = test::as_polygons(test::sphere(0));
    EXPECT_EQ(test::error_of([&] {
                  write_colored_ply(folder.path("s.ply"), mesh, {1, 2});
              }).code,
              ExitCode::internal);
}

/// OKLab (Ottosson 2020) of what an eye sees; sight 0 normal, 1 deuteranope, 2 protanope (Machado et al.
/// 2009).
std::array<double, 3> seen(const Color& color, int sight) {
    static const double views[3][3][3] = {
        {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
        {{0.367322, 0.860646, -0.227968}, {0.280085, 0.672501, 0.047413}, {-0.011820, 0.042940, 0.968881}},
        {{0.152286, 1.052583, -0.204868}, {0.114503, 0.786281, 0.099216}, {-0.003882, -0.048116, 1.051998}}};
    double linear[3];
    for (std::size_t k = 0; k < 3; ++k) {
        const double c = color[k] / 255.0;
        linear[k] = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
    }
    double rgb[3];
    for (int i = 0; i < 3; ++i) {
        const double sum =
            views[sight][i][0] * linear[0] + views[sight][i][1] * linear[1] + views[sight][i][2] * linear[2];
        rgb[i] = std::clamp(sum, 0.0, 1.0);
    }
    const double l = std::cbrt(0.4122214708 * rgb[0] + 0.5363325363 * rgb[1] + 0.0514459929 * rgb[2]);
    const double m = std::cbrt(0.2119034982 * rgb[0] + 0.6806995451 * rgb[1] + 0.1073969566 * rgb[2]);
    const double s = std::cbrt(0.0883024619 * rgb[0] + 0.2817188376 * rgb[1] + 0.6299787005 * rgb[2]);
    return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
            1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
            0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

double least_difference(int parts, int sight) {
    double least = 1e9;
    for (int a = 0; a < parts; ++a) {
        for (int b = 0; b < a; ++b) {
            const auto x = seen(part_color(a), sight);
            const auto y = seen(part_color(b), sight);
            least = std::min(least, std::hypot(x[0] - y[0], x[1] - y[1], x[2] - y[2]));
        }
    }
    return least;
}

TEST(PartColors, StayApartForEveryEye) {
    // About 0.02 is a just noticeable difference.
    EXPECT_GT(least_difference(8, 0), 0.15);
    EXPECT_GT(least_difference(50, 0), 0.06);
    for (const int sight : {1, 2}) {
        EXPECT_GT(least_difference(8, sight), 0.075);
        EXPECT_GT(least_difference(50, sight), 0.045);
    }
}

TEST(PartColors, AnyIntegerHasOne) {
    EXPECT_EQ(part_color(0), part_color(part_color_count));
    EXPECT_EQ(part_color(-1), part_color(part_color_count - 1));
}

}  // namespace
}  // namespace coseg
