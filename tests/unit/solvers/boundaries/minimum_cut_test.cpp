#include "solvers/boundaries/minimum_cut.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "src/base/seeded_random.hpp"

namespace coseg {
namespace {

double cost_of(const std::vector<double>& source_capacity, const std::vector<double>& sink_capacity,
               const std::vector<CutArc>& arcs, const std::vector<char>& side) {
    double cost = 0.0;
    for (std::size_t v = 0; v < side.size(); ++v)
        cost += side[v] != 0 ? source_capacity[v] : sink_capacity[v];
    for (const CutArc& arc : arcs) {
        const char from = side[static_cast<std::size_t>(arc.from)];
        const char to = side[static_cast<std::size_t>(arc.to)];
        if (from < to) cost += arc.capacity;
        if (from > to) cost += arc.reverse_capacity;
    }
    return cost;
}

TEST(MinimumCut, IsTheBestOfAllCutsOfSmallGraphs) {
    constexpr std::size_t nodes = 9;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        SeededStream random(seed);
        std::vector<double> source(nodes), sink(nodes);
        for (std::size_t v = 0; v < nodes; ++v) {
            source[v] = random.uniform() < 0.5 ? random.uniform() : 0.0;
            sink[v] = random.uniform() < 0.5 ? random.uniform() : 0.0;
        }
        std::vector<CutArc> arcs;
        for (int a = 0; a < 9; ++a) {
            for (int b = a + 1; b < 9; ++b) {
                if (random.uniform() < 0.4) arcs.push_back({a, b, random.uniform(), random.uniform()});
            }
        }
        double best = INFINITY;
        for (unsigned bits = 0; bits < 1U << nodes; ++bits) {
            std::vector<char> side(nodes);
            for (std::size_t v = 0; v < nodes; ++v) side[v] = (bits >> v & 1U) != 0 ? 1 : 0;
            best = std::min(best, cost_of(source, sink, arcs, side));
        }
        EXPECT_NEAR(cost_of(source, sink, arcs, minimum_cut(source, sink, arcs)), best, 1e-9) << seed;
    }
}

TEST(MinimumCut, ChainIsCutAtItsWeakestLink) {
    const std::vector<char> side =
        minimum_cut({9, 0, 0, 0}, {0, 0, 0, 9}, {{0, 1, 3, 3}, {1, 2, 1, 1}, {2, 3, 2, 2}});
    EXPECT_EQ(side, (std::vector<char>{0, 0, 1, 1}));
}

TEST(MinimumCut, DirectionsCount) {
    // Node 0 belongs to the sink, node 1 to the source: only the reverse capacity stands between them.
    EXPECT_EQ(minimum_cut({0, 5}, {5, 0}, {{0, 1, 100, 1}}), (std::vector<char>{1, 0}));
    EXPECT_EQ(minimum_cut({0, 5}, {4, 0}, {{0, 1, 1, 100}}), (std::vector<char>{0, 0}));
}

TEST(MinimumCut, EqualCostsStayWithTheSource) {
    EXPECT_EQ(minimum_cut({0, 0}, {0, 0}, {}), (std::vector<char>{0, 0}));
    EXPECT_EQ(minimum_cut({2, 0, 0}, {0, 0, 2}, {{0, 1, 1, 1}, {1, 2, 1, 1}}), (std::vector<char>{0, 0, 1}));
    EXPECT_EQ(minimum_cut({}, {}, {}), std::vector<char>{});
}

}  // namespace
}  // namespace coseg
