#include "src/repair/border_welding.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "src/base/seeded_random.hpp"
#include "src/repair/mesh_repair.hpp"
#include "tests/support/manifold.hpp"
#include "tests/support/shapes.hpp"

namespace coseg {
namespace {

/// A sphere cut along the plane x = 0 into two charts, each with border vertices of its own, moved by up to
/// `distance`.
PolygonMesh two_charts(double distance) {
    const TriMesh sphere = test::sphere(3);
    PolygonMesh mesh = test::as_polygons(sphere);
    std::vector<int> copy(mesh.vertices.size(), -1);
    for (int f = 0; f < sphere.face_count(); ++f) {
        double x = 0.0;
        for (const int v : sphere.faces.col(f)) x += sphere.vertices(0, v);
        if (x < 0.0) continue;
        for (int k = 0; k < 3; ++k) {
            const auto v = static_cast<std::size_t>(sphere.faces(k, f));
            if (copy[v] < 0) {
                copy[v] = static_cast<int>(mesh.vertices.size());
                const auto random = [&](std::uint64_t axis) {
                    return (2.0 * uniform_of(hash_words({v, axis})) - 1.0) * distance / 2.0;
                };
                mesh.vertices.push_back(mesh.vertices[v] + Eigen::Vector3d(random(0), random(1), random(2)));
            }
            mesh.corners[static_cast<std::size_t>(3 * f + k)] = copy[v];
        }
    }
    return mesh;
}

TEST(BorderWelding, ChartsWhoseSeamsDifferBecomeOneSurface) {
    for (const double distance : {1e-12, 1e-9, 1e-6, 1e-5}) {
        const RepairedMesh repaired = repair(two_charts(distance), "charts");
        EXPECT_EQ(test::boundary_edges(repaired.mesh), 0) << distance;
        EXPECT_EQ(repaired.mesh.vertex_count(), test::sphere(3).vertex_count());
        ASSERT_EQ(repaired.warnings.size(),
                  2U);  // the first: vertices that only copies stand for are left out
        EXPECT_NE(repaired.warnings[1].find("on borders that nearly touch are welded"), std::string::npos);
    }
}

TEST(BorderWelding, WiderGapsStay) {
    const PolygonMesh charts = two_charts(1e-3);
    EXPECT_EQ(weld_near_borders(charts, test::each_its_own(charts)).welded, 0);
    // Two sheets, one above the other: near, but their borders run the same way.
    const TriMesh sheet = test::flat_square(8);
    TriMesh above = sheet;
    above.vertices.row(2).array() += 1e-6;
    const PolygonMesh sheets = test::as_polygons(test::disjoint_union(sheet, above));
    EXPECT_EQ(weld_near_borders(sheets, test::each_its_own(sheets)).welded, 0);
    // A slit that is narrow for the size, but not for the length of its edges.
    PolygonMesh dense = two_charts(1e-6);
    for (Eigen::Vector3d& p : dense.vertices) p *= 1e-3;
    dense.vertices.emplace_back(1.0, 0.0, 0.0);
    dense.vertices.emplace_back(0.0, 1.0, 0.0);
    dense.vertices.emplace_back(0.0, 0.0, 1.0);
    const int first = static_cast<int>(dense.vertices.size()) - 3;
    dense.corners.insert(dense.corners.end(), {first, first + 1, first + 2});
    dense.offsets.push_back(static_cast<int>(dense.corners.size()));
    for (std::size_t v = 642; v + 3 < dense.vertices.size(); ++v) dense.vertices[v].x() += 5e-6;
    EXPECT_EQ(weld_near_borders(dense, test::each_its_own(dense)).welded, 0);
}

TEST(BorderWelding, AToleranceThatIsAskedForJoinsChartsFurtherApart) {
    const RepairedMesh apart = repair(two_charts(1e-3), "charts");
    EXPECT_GT(test::boundary_edges(apart.mesh), 0);
    const std::string said = apart.warnings.back();
    EXPECT_NE(said.find("charts: 2 pieces have borders that nearly touch"), std::string::npos) << said;
    // What the sentence suggests is enough.
    const double suggested = std::stod(said.substr(said.rfind(' ')));
    EXPECT_LT(suggested, 2e-3);
    const RepairedMesh joined = repair(two_charts(1e-3), "charts", border_welding_within(suggested));
    EXPECT_EQ(test::boundary_edges(joined.mesh), 0);
    EXPECT_EQ(joined.mesh.face_count(), test::sphere(3).face_count());
    EXPECT_EQ(joined.warnings.back().find("nearly touch, "), std::string::npos);
}

TEST(BorderWelding, ChartsTurnedInsideOutAreJoinedWithinATolerance) {
    PolygonMesh charts = two_charts(1e-3);
    for (int f = 0; f < charts.face_count(); ++f) {
        const auto first = charts.corners.begin() + charts.offsets[static_cast<std::size_t>(f)];
        if (*first >= test::sphere(3).vertex_count()) std::swap(*first, *(first + 1));
    }
    EXPECT_EQ(test::boundary_edges(repair(charts, "charts", border_welding_within(1e-3)).mesh), 0);
}

TEST(BorderWelding, ExactLeavesTheSmallestGapAndSaysSo) {
    const RepairedMesh repaired = repair(two_charts(1e-9), "charts", no_border_welding);
    EXPECT_GT(test::boundary_edges(repaired.mesh), 0);
    EXPECT_NE(repaired.warnings.back().find("2 pieces have borders that nearly touch"), std::string::npos);
    // Equal coordinates are joined all the same.
    EXPECT_EQ(test::boundary_edges(repair(two_charts(0.0), "charts", no_border_welding).mesh), 0);
}

/// Two squares of 16 x 16 cells side by side, `gap` apart.
PolygonMesh slit_square(double gap) {
    const TriMesh left = test::flat_square(16);
    TriMesh right = left;
    right.vertices.row(0).array() += left.vertices.row(0).maxCoeff() + gap;
    return test::as_polygons(test::disjoint_union(left, right));
}

TEST(BorderWelding, AThinGapThatIsGeometryIsNeverClosed) {
    // The skins of a plate without its rim: whatever is asked for, it does not become a pillow.
    const TriMesh skin = test::flat_square(8);
    TriMesh other = skin;
    other.vertices.row(2).array() += 1e-6;
    for (int f = 0; f < other.face_count(); ++f) std::swap(other.faces(0, f), other.faces(1, f));
    const PolygonMesh plate = test::as_polygons(test::disjoint_union(skin, other));
    for (const double tolerance : {1e-5, 1e-3, 1e-2})
        EXPECT_EQ(
            weld_near_borders(plate, test::each_its_own(plate), border_welding_within(tolerance)).welded, 0);
    EXPECT_EQ(near_borders(plate, test::each_its_own(plate)).pieces, 0);
    // A slit wider than a quarter of the edges beside it, though within what was asked for; a narrower one.
    const PolygonMesh wide = slit_square(0.02);
    EXPECT_EQ(weld_near_borders(wide, test::each_its_own(wide), border_welding_within(0.01)).welded, 0);
    const PolygonMesh narrow = slit_square(0.01);
    const double share = 0.01 / used_diagonal(narrow);
    EXPECT_EQ(
        weld_near_borders(narrow, test::each_its_own(narrow), border_welding_within(0.99 * share)).welded, 0);
    EXPECT_EQ(
        weld_near_borders(narrow, test::each_its_own(narrow), border_welding_within(1.01 * share)).welded,
        17);
}

TEST(BorderWelding, PiecesThatNearlyTouchAreCounted) {
    const PolygonMesh slit = slit_square(1e-4);
    const NearBorders near = near_borders(slit, test::each_its_own(slit));
    EXPECT_EQ(near.pieces, 2);
    EXPECT_NEAR(near.distance, 1e-4 / used_diagonal(slit), 1e-9);
    EXPECT_EQ(near_borders(slit_square(0.02), test::each_its_own(slit)).pieces,
              0);  // wider than 1e-3 of the size
    EXPECT_EQ(
        near_borders(slit_square(0.0),
                     weld_near_borders(slit, test::each_its_own(slit), border_welding_within(1e-3)).vertex_of)
            .pieces,
        0);
}

TEST(BorderWelding, ClosedMeshesAndSingleSheetsStay) {
    for (const TriMesh& mesh : {test::sphere(2), test::flat_square(5)}) {
        const PolygonMesh polygons = test::as_polygons(mesh);
        const BorderWelding welding = weld_near_borders(polygons, test::each_its_own(polygons));
        EXPECT_EQ(welding.welded, 0);
        EXPECT_EQ(near_borders(polygons, test::each_its_own(polygons)).pieces, 0);
        EXPECT_EQ(welding.vertex_of, test::each_its_own(polygons));
    }
}

TEST(BorderWelding, DustInOnePlaceEnds) {
    PolygonMesh dust;
    dust.offsets.push_back(0);
    for (int k = 0; k < 3000; ++k) {
        for (std::uint64_t corner = 0; corner < 3; ++corner) {
            const auto random = [&](std::uint64_t axis) {
                return 1e-7 * uniform_of(hash_words({static_cast<std::uint64_t>(k), corner, axis}));
            };
            dust.vertices.emplace_back(random(0), random(1), random(2));
            dust.corners.push_back(static_cast<int>(dust.corners.size()));
        }
        dust.offsets.push_back(static_cast<int>(dust.corners.size()));
    }
    dust.vertices[0] = {1.0, 1.0, 1.0};
    EXPECT_EQ(weld_near_borders(dust, test::each_its_own(dust)).welded, 0);
}

}  // namespace
}  // namespace coseg
