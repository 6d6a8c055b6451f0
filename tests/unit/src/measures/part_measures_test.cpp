#include "src/measures/part_measures.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <numbers>

#include "src/measures/part_borders.hpp"
#include "src/measures/part_pieces.hpp"
#include "tests/support/shapes.hpp"

namespace coseg {
namespace {

/// The part of every face by its centroid.
std::vector<int> measured_parts(const TriMesh& mesh,
                                const std::function<int(const Eigen::Vector3d&)>& part_at) {
    std::vector<int> parts;
    for (int f = 0; f < mesh.face_count(); ++f) {
        Eigen::Vector3d middle = Eigen::Vector3d::Zero();
        for (int k = 0; k < 3; ++k) middle += mesh.vertices.col(mesh.faces(k, f)) / 3.0;
        parts.push_back(part_at(middle));
    }
    return parts;
}

int half_of(const Eigen::Vector3d& p) { return p.x() < 0.5 ? 0 : 1; }

std::vector<PartMeasures> measures_of(const TriMesh& mesh, const std::vector<int>& parts) {
    return part_measures(mesh, parts, part_borders(mesh, parts));
}

TEST(PartMeasures, HalvesOfACube) {
    const TriMesh cube = test::box(1, 1, 1, 4);
    const std::vector<PartMeasures> halves = measures_of(cube, measured_parts(cube, half_of));
    ASSERT_EQ(halves.size(), 2U);
    for (int part = 0; part < 2; ++part) {
        SCOPED_TRACE(part);
        const PartMeasures& half = halves[static_cast<std::size_t>(part)];
        EXPECT_EQ(half.part, part);
        EXPECT_NEAR(half.area, 3.0, 1e-14);
        EXPECT_NEAR(half.share, 0.5, 1e-15);
        EXPECT_EQ(half.pieces, 1);
        ASSERT_TRUE(half.volume.has_value());
        EXPECT_NEAR(*half.volume, 0.5, 1e-14);
        // The end at x = 0 has area 1, the four walls together 2 with their middle at x = 1/4.
        EXPECT_NEAR(half.centroid.x(), part == 0 ? 1.0 / 6.0 : 5.0 / 6.0, 1e-14);
        EXPECT_NEAR(half.centroid.y(), 0.5, 1e-14);
        EXPECT_EQ(half.box.sizes, Eigen::Vector3d(1, 1, 0.5));
        EXPECT_EQ(half.box.center, Eigen::Vector3d(part == 0 ? 0.25 : 0.75, 0.5, 0.5));
        EXPECT_NEAR(half.box.axes.col(2).cwiseAbs().x(), 1.0, 1e-15);
        EXPECT_NEAR(half.box.axes.determinant(), 1.0, 1e-15);
        ASSERT_EQ(half.borders.size(), 1U);
        EXPECT_EQ(half.borders[0].first, 1 - part);
        EXPECT_NEAR(half.borders[0].second, 4.0, 1e-14);
    }
}

TEST(PartMeasures, DoNotDependOnThePlaceOfTheShape) {
    const TriMesh cube = test::box(3, 2, 1, 6);
    const std::vector<int> parts =
        measured_parts(cube, [](const Eigen::Vector3d& p) { return p.x() < 1.0 ? 0 : 1; });
    TriMesh turned = cube;
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    turned.vertices = (2.0 * turn * cube.vertices).colwise() + Eigen::Vector3d(100, -50, 20);
    const std::vector<PartMeasures> before = measures_of(cube, parts);
    const std::vector<PartMeasures> after = measures_of(turned, parts);
    ASSERT_EQ(after.size(), 2U);
    for (std::size_t k = 0; k < 2; ++k) {
        EXPECT_NEAR(after[k].area, 4.0 * before[k].area, 1e-10);
        EXPECT_NEAR(*after[k].volume, 8.0 * *before[k].volume, 1e-9);
        EXPECT_LT((after[k].box.sizes - 2.0 * before[k].box.sizes).norm(), 1e-10);
        EXPECT_LT(
            (after[k].centroid - (2.0 * turn * before[k].centroid + Eigen::Vector3d(100, -50, 20))).norm(),
            1e-10);
        EXPECT_NEAR(after[k].borders[0].second, 2.0 * before[k].borders[0].second, 1e-10);
    }
    EXPECT_NEAR(*before[0].volume, 2.0, 1e-13);
    EXPECT_EQ(before[1].box.sizes, Eigen::Vector3d(2, 2, 1));
}

TEST(PartMeasures, AnOpenSurfaceHasNoVolume) {
    const TriMesh square = test::flat_square(4);
    const std::vector<PartMeasures> halves = measures_of(square, measured_parts(square, half_of));
    for (const PartMeasures& half : halves) {
        EXPECT_FALSE(half.volume.has_value());
        EXPECT_NEAR(half.area, 0.5, 1e-15);
        EXPECT_EQ(half.box.sizes, Eigen::Vector3d(1, 0.5, 0));
        EXPECT_NEAR(half.borders[0].second, 1.0, 1e-15);
    }
    // A ball with a cap of another part: the cap is open where a face is missing, the rest is not.
    TriMesh ball = test::sphere(2);
    const std::vector<int> parts =
        measured_parts(ball, [](const Eigen::Vector3d& p) { return p.z() > 0.5 ? 1 : 0; });
    int cap = 0;  // the face nearest to the pole, away from the border
    for (int f = 0; f < ball.face_count(); ++f) {
        const auto height = [&](int face) {
            return ball.vertices(2, ball.faces(0, face)) + ball.vertices(2, ball.faces(1, face)) +
                   ball.vertices(2, ball.faces(2, face));
        };
        if (height(f) > height(cap)) cap = f;
    }
    std::vector<int> fewer = parts;
    fewer.erase(fewer.begin() + cap);
    Eigen::Matrix3Xi faces(3, ball.face_count() - 1);
    faces << ball.faces.leftCols(cap), ball.faces.rightCols(ball.face_count() - cap - 1);
    ball.faces = faces;
    const std::vector<PartMeasures> measured = measures_of(ball, fewer);
    EXPECT_TRUE(measured[0].volume.has_value());
    EXPECT_FALSE(measured[1].volume.has_value());
}

TEST(PartMeasures, PiecesOfAPartAreCountedAndAddUp) {
    TriMesh far = test::sphere(3, 2.0);
    far.vertices.row(0).array() += 10.0;
    const TriMesh balls = test::disjoint_union(test::sphere(3, 1.0), far);
    const std::vector<int> one(static_cast<std::size_t>(balls.face_count()), 7);
    const std::vector<PartMeasures> measured = measures_of(balls, one);
    ASSERT_EQ(measured.size(), 1U);
    EXPECT_EQ(measured[0].part, 7);
    EXPECT_EQ(measured[0].pieces, 2);
    EXPECT_TRUE(measured[0].borders.empty());
    EXPECT_NEAR(*measured[0].volume, 4.0 / 3.0 * std::numbers::pi * 9.0, 0.6);
    const std::vector<int> piece = part_pieces(balls, one);
    EXPECT_EQ(piece.front(), 0);
    EXPECT_EQ(piece.back(), 1);
    EXPECT_EQ(std::count(piece.begin(), piece.end(), 0), balls.face_count() / 2);
}

TEST(PartBorders, OfACubeCutInHalvesIsOneClosedCurve) {
    const TriMesh cube = test::box(1, 1, 1, 4);
    const std::vector<BorderCurve> curves = part_borders(cube, measured_parts(cube, half_of));
    ASSERT_EQ(curves.size(), 1U);
    EXPECT_TRUE(curves[0].is_closed);
    EXPECT_EQ(curves[0].vertices.size(), 16U);
    EXPECT_NEAR(curves[0].length, 4.0, 1e-14);
    EXPECT_EQ(curves[0].vertices.front(),
              *std::min_element(curves[0].vertices.begin(), curves[0].vertices.end()));
    Eigen::Vector3d turn = Eigen::Vector3d::Zero();
    const Eigen::Vector3d middle(0.5, 0.5, 0.5);
    for (std::size_t k = 0; k < 16; ++k) {
        const Eigen::Vector3d a = cube.vertices.col(curves[0].vertices[k]);
        const Eigen::Vector3d b = cube.vertices.col(curves[0].vertices[(k + 1) % 16]);
        EXPECT_EQ(a.x(), 0.5);
        EXPECT_NEAR((b - a).norm(), 0.25, 1e-15);
        turn += 0.5 * (a - middle).cross(b - middle);
    }
    // Whoever walks along it upright on the cube has part 0, at x < 0.5, on the left side.
    EXPECT_LT((turn + Eigen::Vector3d(1, 0, 0)).norm(), 1e-14);
}

TEST(PartBorders, EndWhereThreePartsMeet) {
    const TriMesh cube = test::box(1, 1, 1, 4);
    const std::vector<int> parts = measured_parts(cube, [](const Eigen::Vector3d& p) {
        return p.x() < 0.5 ? 0 : p.y() < 0.5 ? 1 : 2;
    });
    const std::vector<BorderCurve> curves = part_borders(cube, parts);
    ASSERT_EQ(curves.size(), 3U);
    for (const BorderCurve& curve : curves) {
        EXPECT_FALSE(curve.is_closed);
        EXPECT_NEAR(curve.length, 2.0, 1e-14);
        EXPECT_EQ(curve.vertices.size(), 9U);
        for (const int end : {curve.vertices.front(), curve.vertices.back()}) {
            EXPECT_EQ(cube.vertices(0, end), 0.5);
            EXPECT_EQ(cube.vertices(1, end), 0.5);
        }
    }
    EXPECT_EQ(std::pair(curves[1].part_a, curves[1].part_b), std::pair(0, 2));
    const std::vector<PartMeasures> measured = measures_of(cube, parts);
    EXPECT_NEAR(*measured[0].volume, 0.5, 1e-14);
    // The lid of a border that lies in no plane is a guess: it cuts the inner edge of the quarter off.
    EXPECT_NEAR(*measured[1].volume, 0.1875, 1e-14);
    EXPECT_EQ(measured[0].borders.size(), 2U);
}

TEST(PartBorders, TwoRingsAroundABar) {
    const TriMesh bar = test::box(4, 1, 1, 8);
    const std::vector<int> parts =
        measured_parts(bar, [](const Eigen::Vector3d& p) { return p.x() > 1.0 && p.x() < 3.0 ? 1 : 0; });
    const std::vector<BorderCurve> curves = part_borders(bar, parts);
    ASSERT_EQ(curves.size(), 2U);
    EXPECT_TRUE(curves[0].is_closed && curves[1].is_closed);
    const std::vector<PartMeasures> measured = measures_of(bar, parts);
    EXPECT_EQ(measured[0].pieces, 2);
    EXPECT_NEAR(measured[0].borders[0].second, 8.0, 1e-13);
    EXPECT_NEAR(*measured[0].volume, 2.0, 1e-13);
    EXPECT_NEAR(*measured[1].volume, 2.0, 1e-13);
}

TEST(OrientedBox, OfPointsOnALineAndAPoint) {
    EXPECT_EQ(oriented_box({{1, 2, 3}}, {}).center, Eigen::Vector3d(1, 2, 3));
    EXPECT_EQ(oriented_box({{1, 2, 3}}, {}).sizes, Eigen::Vector3d(0, 0, 0));
    const OrientedBox line = oriented_box({{0, 0, 0}, {0, 3, 0}}, {});
    EXPECT_EQ(line.sizes, Eigen::Vector3d(3, 0, 0));
    EXPECT_EQ(line.axes.col(0), Eigen::Vector3d(0, 1, 0));
}

}  // namespace
}  // namespace coseg
