#include "src/mesh/dual_graph.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "src/mesh/spanning_joins.hpp"
#include "tests/support/awkward_shapes.hpp"
#include "tests/support/shapes.hpp"

namespace coseg {
namespace {

bool is_connected(const DualGraph& graph) {
    std::vector<bool> seen(static_cast<std::size_t>(graph.face_count), false);
    std::vector<int> stack{0};
    seen[0] = true;
    int count = 1;
    while (!stack.empty()) {
        const auto f = static_cast<std::size_t>(stack.back());
        stack.pop_back();
        for (int k = graph.offsets[f]; k < graph.offsets[f + 1]; ++k) {
            const int g = graph.other_face(graph.incident[static_cast<std::size_t>(k)], static_cast<int>(f));
            if (seen[static_cast<std::size_t>(g)]) continue;
            seen[static_cast<std::size_t>(g)] = true;
            stack.push_back(g);
            ++count;
        }
    }
    return count == graph.face_count;
}

int root_of(std::vector<int>& parent, int i) {
    while (parent[static_cast<std::size_t>(i)] != i) i = parent[static_cast<std::size_t>(i)];
    return i;
}

/// Kruskal over all pairs of points of different groups.
std::vector<std::pair<int, int>> joins_by_brute_force(const Eigen::Matrix3Xd& points,
                                                      const std::vector<int>& group, int groups) {
    std::vector<std::tuple<double, int, int>> pairs;
    for (int a = 0; a < points.cols(); ++a) {
        for (int b = a + 1; b < points.cols(); ++b) {
            if (group[static_cast<std::size_t>(a)] == group[static_cast<std::size_t>(b)]) continue;
            pairs.emplace_back((points.col(a) - points.col(b)).squaredNorm(), a, b);
        }
    }
    std::sort(pairs.begin(), pairs.end());
    std::vector<int> parent(static_cast<std::size_t>(groups));
    std::iota(parent.begin(), parent.end(), 0);
    std::vector<std::pair<int, int>> joins;
    for (const auto& [squared, a, b] : pairs) {
        const int x = root_of(parent, group[static_cast<std::size_t>(a)]);
        const int y = root_of(parent, group[static_cast<std::size_t>(b)]);
        if (x == y) continue;
        parent[static_cast<std::size_t>(x)] = y;
        joins.emplace_back(a, b);
    }
    std::sort(joins.begin(), joins.end());
    return joins;
}

std::vector<std::pair<int, int>> pairs_of(const std::vector<PointJoin>& joins) {
    std::vector<std::pair<int, int>> pairs;
    for (const PointJoin& join : joins) pairs.emplace_back(join.point_a, join.point_b);
    return pairs;
}

/// n^3 small boxes on a lattice, each moved a little.
TriMesh many_boxes(int n, double shake) {
    TriMesh all;
    for (int i = 0; i < n * n * n; ++i) {
        TriMesh one = test::box(0.3, 0.4, 0.5, 2);
        const double s = std::sin(12.9898 * i) * 43758.5453;
        one.vertices.colwise() += Eigen::Vector3d(i % n, i / n % n, i / n / n) +
                                  shake * (s - std::floor(s)) * Eigen::Vector3d(0.3, 0.2, 0.1);
        all = i == 0 ? one : test::disjoint_union(all, one);
    }
    return all;
}

TEST(SpanningJoins, AreTheMinimumSpanningTree) {
    for (const double shake : {0.0, 1.0}) {  // 0: a lattice full of equal distances
        const TriMesh mesh = many_boxes(3, shake);
        const FaceGeometry geometry = face_geometry(mesh);
        const std::vector<int> component = face_components(dual_graph(mesh, geometry));
        EXPECT_EQ(pairs_of(spanning_joins(geometry.centroid, component, 27)),
                  joins_by_brute_force(geometry.centroid, component, 27));
    }
}

TEST(SpanningJoins, EveryPointItsOwnGroup) {
    const Eigen::Matrix3Xd points = test::jittered(test::sphere(2), 0.3).vertices;
    std::vector<int> group(static_cast<std::size_t>(points.cols()));
    std::iota(group.begin(), group.end(), 0);
    const int groups = static_cast<int>(group.size());
    EXPECT_EQ(pairs_of(spanning_joins(points, group, groups)), joins_by_brute_force(points, group, groups));
}

TEST(SpanningJoins, CoincidentPointsAreJoinedAtDistanceZero) {
    const Eigen::Matrix3Xd points = Eigen::Matrix3Xd::Zero(3, 50);
    std::vector<int> group(50);
    for (int i = 0; i < 50; ++i) group[static_cast<std::size_t>(i)] = i % 10;
    const std::vector<PointJoin> joins = spanning_joins(points, group, 10);
    EXPECT_EQ(pairs_of(joins), joins_by_brute_force(points, group, 10));
    for (const PointJoin& join : joins) EXPECT_EQ(join.distance, 0.0);
}

TEST(DualGraphComponents, OneComponentHasNoVirtualEdges) {
    const TriMesh mesh = test::torus(1, 0.3, 20, 10);
    const DualGraph graph = dual_graph(mesh, face_geometry(mesh));
    EXPECT_TRUE(std::none_of(graph.edges.begin(), graph.edges.end(),
                             [](const DualEdge& e) { return e.is_virtual(); }));
    EXPECT_TRUE(is_connected(graph));
}

TEST(DualGraphComponents, TwoSpheresAreJoinedWhereTheyAreNearest) {
    TriMesh right = test::sphere(3);
    right.vertices.row(0).array() += 2.5;
    const TriMesh mesh = test::disjoint_union(test::sphere(3), right);
    const FaceGeometry geometry = face_geometry(mesh);
    const DualGraph graph = dual_graph(mesh, geometry);
    int joins = 0;
    for (const DualEdge& edge : graph.edges) {
        if (!edge.is_virtual()) continue;
        ++joins;
        EXPECT_LT(edge.face_a, mesh.face_count() / 2);
        EXPECT_GE(edge.face_b, mesh.face_count() / 2);
        EXPECT_EQ(edge.vertex_a, -1);
        EXPECT_EQ(edge.vertex_b, -1);
        EXPECT_EQ(edge.dihedral, std::numbers::pi);
        EXPECT_NEAR(edge.length, 0.1 * std::sqrt(geometry.total_area / mesh.face_count()), 1e-15);
        const double gap = (geometry.centroid.col(edge.face_a) - geometry.centroid.col(edge.face_b)).norm();
        double nearest = 1e9;
        for (int a = 0; a < mesh.face_count() / 2; ++a) {
            for (int b = mesh.face_count() / 2; b < mesh.face_count(); ++b) {
                nearest = std::min(nearest, (geometry.centroid.col(a) - geometry.centroid.col(b)).norm());
            }
        }
        EXPECT_EQ(gap, nearest);
    }
    EXPECT_EQ(joins, 1);
    EXPECT_TRUE(is_connected(graph));
}

TEST(DualGraphComponents, ManyComponentsAreJoinedAndEdgesStaySorted) {
    const TriMesh mesh = many_boxes(4, 1.0);
    const DualGraph graph = dual_graph(mesh, face_geometry(mesh));
    EXPECT_TRUE(is_connected(graph));
    EXPECT_EQ(std::count_if(graph.edges.begin(), graph.edges.end(),
                            [](const DualEdge& e) { return e.is_virtual(); }),
              63);
    EXPECT_TRUE(
        std::is_sorted(graph.edges.begin(), graph.edges.end(), [](const DualEdge& x, const DualEdge& y) {
            return std::pair{x.face_a, x.face_b} < std::pair{y.face_a, y.face_b};
        }));
    const std::vector<int> component = face_components(graph);
    EXPECT_EQ(*std::max_element(component.begin(), component.end()), 63);
    for (int f = 0; f < graph.face_count; ++f) {
        const auto i = static_cast<std::size_t>(f);
        EXPECT_TRUE(std::is_sorted(graph.incident.begin() + graph.offsets[i],
                                   graph.incident.begin() + graph.offsets[i + 1]));
    }
}

TEST(DualGraphComponents, AwkwardMeshesAreConnected) {
    for (const auto& [name, mesh] : test::awkward_meshes()) {
        const DualGraph graph = dual_graph(mesh, face_geometry(mesh));
        EXPECT_TRUE(is_connected(graph)) << name;
        for (const DualEdge& edge : graph.edges) {
            EXPECT_TRUE(std::isfinite(edge.dihedral) && std::isfinite(edge.length)) << name;
            EXPECT_LT(edge.face_a, edge.face_b) << name;
        }
    }
}

}  // namespace
}  // namespace coseg
