#include "src/repair/border_welding.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

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

std::vector<int> each_its_own(const PolygonMesh& mesh) {
    std::vector<int> vertex_of(mesh.vertices.size());
    std::iota(vertex_of.begin(), vertex_of.end(), 0);
    return vertex_of;
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
    EXPECT_EQ(weld_near_borders(charts, each_its_own(charts)).welded, 0);
    // Two sheets, one above the other: near, but their borders run the same way.
    const TriMesh sheet = test::flat_square(8);
    TriMesh above = sheet;
    above.vertices.row(2).array() += 1e-6;
    const PolygonMesh sheets = test::as_polygons(test::disjoint_union(sheet, above));
    EXPECT_EQ(weld_near_borders(sheets, each_its_own(sheets)).welded, 0);
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
    EXPECT_EQ(weld_near_borders(dense, each_its_own(dense)).welded, 0);
}

TEST(BorderWelding, ClosedMeshesAndSingleSheetsStay) {
    for (const TriMesh& mesh : {test::sphere(2), test::flat_square(5)}) {
        const PolygonMesh polygons = test::as_polygons(mesh);
        const BorderWelding welding = weld_near_borders(polygons, each_its_own(polygons));
        EXPECT_EQ(welding.welded, 0);
        EXPECT_EQ(welding.vertex_of, each_its_own(polygons));
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
    EXPECT_EQ(weld_near_borders(dust, each_its_own(dust)).welded, 0);
}

}  // namespace
}  // namespace coseg
