#include "solvers/oversegmentation/face_agglomeration.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "src/base/seeded_random.hpp"
#include "src/mesh/dual_graph.hpp"
#include "tests/support/shapes.hpp"

namespace coseg {
namespace {

/// The face graph of a mesh with weights and masses that never tie.
WeightedGraph random_face_graph(const TriMesh& mesh) {
    std::vector<WeightedEdge> edges;
    for (const DualEdge& e : dual_graph(mesh, face_geometry(mesh)).edges) {
        const auto key =
            hash_words({static_cast<std::uint64_t>(e.vertex_a), static_cast<std::uint64_t>(e.vertex_b)});
        edges.push_back({e.face_a, e.face_b, std::exp(normal_of(key))});
    }
    std::vector<double> mass;
    for (int f = 0; f < mesh.face_count(); ++f)
        mass.push_back(std::exp(0.5 * normal_of(static_cast<std::uint64_t>(f))));
    return weighted_graph(mass, edges);
}

/// The definition: all pairs are looked at before every merge.
std::vector<int> agglomerate_by_definition(const WeightedGraph& graph, int target) {
    std::vector<int> group(graph.mass.size());
    std::iota(group.begin(), group.end(), 0);
    for (int count = graph.node_count(); count > target; --count) {
        const WeightedGraph quotient = contracted_graph(graph, group, count);
        std::vector<double> cut(quotient.mass.size(), 0.0);
        for (std::size_t v = 0; v < cut.size(); ++v) {
            for (int k = quotient.offsets[v]; k < quotient.offsets[v + 1]; ++k)
                cut[v] += quotient.weights[static_cast<std::size_t>(k)];
        }
        double best = INFINITY;
        int best_a = -1, best_b = -1;
        for (std::size_t a = 0; a < cut.size(); ++a) {
            for (int k = quotient.offsets[a]; k < quotient.offsets[a + 1]; ++k) {
                const auto b = static_cast<std::size_t>(quotient.neighbors[static_cast<std::size_t>(k)]);
                if (b < a) continue;
                const double shared = quotient.weights[static_cast<std::size_t>(k)];
                const double change =
                    (cut[a] + cut[b] - 2.0 * shared) / (quotient.mass[a] + quotient.mass[b]) -
                    cut[a] / quotient.mass[a] - cut[b] / quotient.mass[b];
                if (change < best) {
                    best = change;
                    best_a = static_cast<int>(a);
                    best_b = static_cast<int>(b);
                }
            }
        }
        for (int& g : group) {
            if (g == best_b)
                g = best_a;
            else if (g > best_b)
                --g;
        }
    }
    return group;
}

TEST(Agglomeration, MergesAsTheDefinitionSays) {
    const WeightedGraph graph = random_face_graph(test::torus(1.0, 0.4, 12, 8));
    for (const int target : {150, 60, 7, 1})
        EXPECT_EQ(agglomerate(graph, target), agglomerate_by_definition(graph, target));
}

TEST(Agglomeration, GroupsAreConnectedAndNumberedByLowestNode) {
    const WeightedGraph graph = random_face_graph(test::sphere(3));
    const std::vector<int> group = agglomerate(graph, 90);
    int highest = -1;
    for (const int g : group) {
        EXPECT_LE(g, highest + 1);
        highest = std::max(highest, g);
    }
    EXPECT_EQ(highest, 89);
    for (int g = 0; g < 90; ++g) {
        std::vector<int> nodes;
        for (std::size_t v = 0; v < group.size(); ++v) {
            if (group[v] == g) nodes.push_back(static_cast<int>(v));
        }
        const std::vector<int> component = connected_components(induced_subgraph(graph, nodes));
        EXPECT_EQ(*std::max_element(component.begin(), component.end()), 0) << g;
    }
}

TEST(Agglomeration, StrongLinksMergeFirst) {
    const WeightedGraph graph = weighted_graph({1, 1, 1, 1}, {{0, 1, 1.0}, {1, 2, 0.1}, {2, 3, 1.0}});
    EXPECT_EQ(agglomerate(graph, 2), (std::vector<int>{0, 0, 1, 1}));
}

TEST(Agglomeration, EnoughGroupsAlreadyLeavesEveryNodeAlone) {
    const WeightedGraph graph = weighted_graph({1, 1, 1}, {{0, 1, 1.0}, {1, 2, 1.0}});
    EXPECT_EQ(agglomerate(graph, 3), (std::vector<int>{0, 1, 2}));
    EXPECT_EQ(agglomerate(graph, 100), (std::vector<int>{0, 1, 2}));
}

TEST(Agglomeration, StopsWhereNothingTouches) {
    const WeightedGraph graph = weighted_graph({1, 1, 1, 1}, {{0, 2, 1.0}});
    EXPECT_EQ(agglomerate(graph, 1), (std::vector<int>{0, 1, 0, 2}));
}

TEST(WeightedGraph, ParallelEdgesAddUpAndLoopsGo) {
    const WeightedGraph graph = weighted_graph({1, 2}, {{1, 0, 0.5}, {0, 0, 9.0}, {0, 1, 0.25}});
    EXPECT_EQ(graph.offsets, (std::vector<int>{0, 1, 2}));
    EXPECT_EQ(graph.neighbors, (std::vector<int>{1, 0}));
    EXPECT_EQ(graph.weights, (std::vector<double>{0.75, 0.75}));
}

TEST(WeightedGraph, ContractionAddsMassesAndBoundaries) {
    const WeightedGraph square = weighted_graph({1, 2, 3, 4}, {{0, 1, 1}, {1, 2, 2}, {2, 3, 4}, {3, 0, 8}});
    const WeightedGraph two = contracted_graph(square, {0, 0, 1, 1}, 2);
    EXPECT_EQ(two.mass, (std::vector<double>{3, 7}));
    EXPECT_EQ(two.weights, (std::vector<double>{10, 10}));
}

}  // namespace
}  // namespace coseg
