#include "io/mesh_files/ply_format.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>

#include "io/mesh_files/mesh_reader.hpp"
#include "src/pictures/part_colors.hpp"
#include "tests/support/errors.hpp"
#include "tests/support/manifold.hpp"
#include "tests/support/shapes.hpp"
#include "tests/support/temporary_folder.hpp"

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
