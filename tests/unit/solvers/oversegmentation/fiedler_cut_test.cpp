#include "solvers/oversegmentation/fiedler_cut.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "src/base/seeded_random.hpp"

namespace coseg {
namespace {

WeightedGraph path(int n) {
    std::vector<WeightedEdge> edges;
    for (int v = 0; v + 1 < n; ++v) edges.push_back({v, v + 1, 1.0});
    return weighted_graph(std::vector<double>(static_cast<std::size_t>(n), 1.0), edges);
}

WeightedGraph grid(int columns, int rows) {
    std::vector<WeightedEdge> edges;
    for (int i = 0; i < columns; ++i) {
        for (int j = 0; j < rows; ++j) {
            if (i + 1 < columns) edges.push_back({i * rows + j, (i + 1) * rows + j, 1.0});
            if (j + 1 < rows) edges.push_back({i * rows + j, i * rows + j + 1, 1.0});
        }
    }
    return weighted_graph(std::vector<double>(static_cast<std::size_t>(columns * rows), 1.0), edges);
}

WeightedGraph bridged_cliques(int size) {
    std::vector<WeightedEdge> edges{{0, size, 1.0}};
    for (const int first : {0, size}) {
        for (int a = 0; a < size; ++a) {
            for (int b = a + 1; b < size; ++b) edges.push_back({first + a, first + b, 1.0});
        }
    }
    return weighted_graph(std::vector<double>(static_cast<std::size_t>(2 * size), 1.0), edges);
}

double cut_value(const WeightedGraph& graph, const std::vector<char>& side) {
    double cut = 0.0;
    double mass[2] = {0.0, 0.0};
    for (std::size_t v = 0; v < side.size(); ++v) {
        mass[static_cast<int>(side[v])] += graph.mass[v];
        for (int k = graph.offsets[v]; k < graph.offsets[v + 1]; ++k) {
            const auto slot = static_cast<std::size_t>(k);
            if (side[static_cast<std::size_t>(graph.neighbors[slot])] != side[v])
                cut += 0.5 * graph.weights[slot];
        }
    }
    return cut / mass[0] + cut / mass[1];
}

/// max |L x - mu M x| relative to mu |x|.
double residual(const WeightedGraph& graph, const FiedlerPair& pair) {
    double largest = 0.0, scale = 0.0;
    for (std::size_t v = 0; v < graph.mass.size(); ++v) {
        double row = -pair.value * graph.mass[v] * pair.vector[v];
        for (int k = graph.offsets[v]; k < graph.offsets[v + 1]; ++k) {
            const auto slot = static_cast<std::size_t>(k);
            row += graph.weights[slot] *
                   (pair.vector[v] - pair.vector[static_cast<std::size_t>(graph.neighbors[slot])]);
        }
        largest = std::max(largest, std::abs(row));
        scale = std::max(scale, pair.value * graph.mass[v] * std::abs(pair.vector[v]));
    }
    return largest / scale;
}

/// Entries of the Cholesky factor of L + M where nodes are eliminated by their number.
int factor_entries(const WeightedGraph& graph) {
    std::vector<std::set<int>> later(graph.mass.size());
    int entries = 0;
    for (std::size_t v = 0; v < later.size(); ++v) {
        for (int k = graph.offsets[v]; k < graph.offsets[v + 1]; ++k) {
            const int u = graph.neighbors[static_cast<std::size_t>(k)];
            if (u > static_cast<int>(v)) later[v].insert(u);
        }
    }
    for (std::set<int>& after : later) {
        entries += 1 + static_cast<int>(after.size());
        if (after.empty()) continue;
        std::set<int>& parent = later[static_cast<std::size_t>(*after.begin())];
        parent.insert(std::next(after.begin()), after.end());
    }
    return entries;
}

TEST(EliminationPlaces, ArePlacesAndFillLessThanTheOrderOfAGrid) {
    const WeightedGraph by_columns = grid(30, 30);
    const std::vector<int> place = elimination_places(by_columns);
    std::vector<int> sorted = place;
    std::sort(sorted.begin(), sorted.end());
    for (int v = 0; v < 900; ++v) ASSERT_EQ(sorted[static_cast<std::size_t>(v)], v);
    const WeightedGraph renumbered = contracted_graph(by_columns, place, 900);
    // A band of 30 has some 900 x 31 entries; minimum degree less than half of that.
    EXPECT_LT(factor_entries(renumbered), factor_entries(by_columns) / 2);
    EXPECT_EQ(renumbered.weights.size(), by_columns.weights.size());
}

TEST(FiedlerPair, PathHasTheKnownValue) {
    for (const int n : {2, 3, 10, 48, 49, 400}) {
        const double expected = 2.0 * (1.0 - std::cos(std::numbers::pi / n));
        const FiedlerPair pair = fiedler_pair(path(n));
        EXPECT_NEAR(pair.value / expected, 1.0, 1e-6) << n;
        EXPECT_EQ(pair.origin, n > 48 ? CutOrigin::lanczos : CutOrigin::dense);
    }
}

TEST(FiedlerPair, CompleteGraphAndCycleHaveTheKnownValues) {
    for (const int n : {5, 60}) {
        std::vector<WeightedEdge> all, ring;
        for (int a = 0; a < n; ++a) {
            ring.push_back({a, (a + 1) % n, 1.0});
            for (int b = a + 1; b < n; ++b) all.push_back({a, b, 1.0});
        }
        const std::vector<double> mass(static_cast<std::size_t>(n), 1.0);
        EXPECT_NEAR(fiedler_pair(weighted_graph(mass, all)).value, n, 1e-6 * n);
        const double expected = 2.0 * (1.0 - std::cos(2.0 * std::numbers::pi / n));
        EXPECT_NEAR(fiedler_pair(weighted_graph(mass, ring)).value / expected, 1.0, 1e-6);
    }
}

TEST(FiedlerPair, TwoNodesWithMassesFollowTheFormula) {
    const FiedlerPair pair = fiedler_pair(weighted_graph({2.0, 5.0}, {{0, 1, 3.0}}));
    EXPECT_NEAR(pair.value, 3.0 * (1.0 / 2.0 + 1.0 / 5.0), 1e-12);
}

TEST(FiedlerPair, SolvesTheGeneralisedProblemWithUnequalMassesAndWeights) {
    WeightedGraph graph = grid(40, 9);
    std::vector<WeightedEdge> edges;
    for (int v = 0; v < graph.node_count(); ++v) {
        graph.mass[static_cast<std::size_t>(v)] = std::exp(normal_of(static_cast<std::uint64_t>(v)));
        for (int k = graph.offsets[static_cast<std::size_t>(v)];
             k < graph.offsets[static_cast<std::size_t>(v) + 1]; ++k) {
            const int u = graph.neighbors[static_cast<std::size_t>(k)];
            if (v < u)
                edges.push_back(
                    {v, u,
                     std::pow(10.0, -4.0 * uniform_of(mix_bits(static_cast<std::uint64_t>(v * 1000 + u))))});
        }
    }
    graph = weighted_graph(graph.mass, edges);
    const FiedlerPair pair = fiedler_pair(graph);
    ASSERT_EQ(pair.origin, CutOrigin::lanczos);
    EXPECT_LT(residual(graph, pair), 1e-4);
    double constant = 0.0, norm = 0.0;
    for (std::size_t v = 0; v < graph.mass.size(); ++v) {
        constant += graph.mass[v] * pair.vector[v];
        norm += graph.mass[v] * pair.vector[v] * pair.vector[v];
    }
    EXPECT_NEAR(constant, 0.0, 1e-8);
    EXPECT_NEAR(norm, 1.0, 1e-8);
}

TEST(FiedlerCut, PathIsCutInTheMiddle) {
    for (const int n : {2, 10, 200}) {
        const TwoWayCut cut = fiedler_cut(path(n));
        for (int v = 0; v < n; ++v)
            EXPECT_EQ(cut.side[static_cast<std::size_t>(v)], v < n / 2 ? 0 : 1) << n << " " << v;
        EXPECT_NEAR(cut.value, 4.0 / n, 1e-12);
    }
}

TEST(FiedlerCut, MassesMoveTheCut) {
    WeightedGraph graph = path(10);
    graph.mass[0] = 8.0;  // as heavy as the rest nearly: 8 | 9 beats every other place
    const TwoWayCut cut = fiedler_cut(graph);
    EXPECT_EQ(cut.side, (std::vector<char>{0, 1, 1, 1, 1, 1, 1, 1, 1, 1}));
    EXPECT_NEAR(cut.value, 1.0 / 8.0 + 1.0 / 9.0, 1e-12);
}

TEST(FiedlerCut, BridgedCliquesAreCutAtTheBridge) {
    for (const int size : {3, 8, 40}) {
        const TwoWayCut cut = fiedler_cut(bridged_cliques(size));
        for (int v = 0; v < 2 * size; ++v) EXPECT_EQ(cut.side[static_cast<std::size_t>(v)], v < size ? 0 : 1);
        EXPECT_NEAR(cut.value, 2.0 / size, 1e-12);
    }
}

TEST(FiedlerCut, GridIsCutAcross) {
    const TwoWayCut cut = fiedler_cut(grid(30, 10));
    EXPECT_NEAR(cut.value, 2.0 * 10.0 / 150.0, 1e-12);
    EXPECT_NEAR(cut.fiedler_value, 2.0 * (1.0 - std::cos(std::numbers::pi / 30.0)), 1e-8);
}

TEST(FiedlerCut, ValueIsThatOfTheSidesAndNoLessThanTheEigenvalue) {
    for (const int columns : {4, 12, 25}) {
        const WeightedGraph graph = grid(columns, 7);
        const TwoWayCut cut = fiedler_cut(graph);
        EXPECT_NEAR(cut.value, cut_value(graph, cut.side), 1e-12);
        EXPECT_GE(cut.value, cut.fiedler_value * (1.0 - 1e-6));  // the eigenvalue is the relaxed minimum
        EXPECT_EQ(cut.side[0], 0);
    }
}

TEST(FiedlerCut, DisconnectedGraphFallsApartAtNoCost) {
    const WeightedGraph graph = weighted_graph({1, 1, 1, 1, 1}, {{0, 2, 1.0}, {1, 3, 1.0}, {3, 4, 1.0}});
    const TwoWayCut cut = fiedler_cut(graph);
    EXPECT_EQ(cut.origin, CutOrigin::components);
    EXPECT_EQ(cut.side, (std::vector<char>{0, 1, 0, 1, 1}));
    EXPECT_EQ(cut.value, 0.0);
}

TEST(FiedlerCut, ExtremeWeightsStillGiveTwoSides) {
    for (const double weight : {1e-300, 1e-12, 1e12, 1e200}) {
        for (const int n : {6, 100}) {
            std::vector<WeightedEdge> edges;
            for (int v = 0; v + 1 < n; ++v) edges.push_back({v, v + 1, v % 2 == 0 ? weight : 1.0});
            const WeightedGraph graph =
                weighted_graph(std::vector<double>(static_cast<std::size_t>(n), 1.0 / weight), edges);
            const TwoWayCut cut = fiedler_cut(graph);
            const auto ones = std::count(cut.side.begin(), cut.side.end(), 1);
            EXPECT_GT(ones, 0) << weight << " " << n;
            EXPECT_LT(ones, n) << weight << " " << n;
        }
    }
}

TEST(FiedlerCut, FallsBackToDistancesWhereNumbersOverflow) {
    const double huge = std::numeric_limits<double>::max();
    const WeightedGraph graph =
        weighted_graph({1e-300, 1e-300, 1e-300, 1e-300}, {{0, 1, huge}, {1, 2, huge}, {2, 3, huge}});
    const TwoWayCut cut = fiedler_cut(graph);
    EXPECT_EQ(cut.origin, CutOrigin::breadth_first);
    EXPECT_NE(std::count(cut.side.begin(), cut.side.end(), 1), 0);
    EXPECT_EQ(cut.side[0], 0);
}

}  // namespace
}  // namespace coseg
