#include "solvers/oversegmentation/weighted_graph.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "src/base/index.hpp"

namespace coseg {

namespace {

/// Sorts every node's run of neighbours and adds up repetitions; both directions see the same order of
/// additions.
void sort_and_add_up(WeightedGraph& graph) {
    std::vector<std::pair<int, double>> run;
    std::size_t write = 0;
    int begin = 0;
    for (std::size_t v = 0; v < graph.mass.size(); ++v) {
        const int end = graph.offsets[v + 1];
        run.clear();
        for (int k = begin; k < end; ++k) {
            run.emplace_back(graph.neighbors[at(k)], graph.weights[at(k)]);
        }
        const auto is_lower = [](const auto& x, const auto& y) { return x.first < y.first; };
        // Edges of a dual graph come in order, and a stable sort allocates even where there is nothing to do.
        if (!std::is_sorted(run.begin(), run.end(), is_lower))
            std::stable_sort(run.begin(), run.end(), is_lower);
        graph.offsets[v] = static_cast<int>(write);
        for (std::size_t k = 0; k < run.size(); ++k) {
            if (k > 0 && run[k].first == run[k - 1].first) {
                graph.weights[write - 1] += run[k].second;
                continue;
            }
            graph.neighbors[write] = run[k].first;
            graph.weights[write++] = run[k].second;
        }
        begin = end;
    }
    graph.offsets.back() = static_cast<int>(write);
    graph.neighbors.resize(write);
    graph.weights.resize(write);
}

}  // namespace

WeightedGraph weighted_graph(std::vector<double> mass, const std::vector<WeightedEdge>& edges) {
    WeightedGraph graph;
    graph.mass = std::move(mass);
    graph.offsets.assign(graph.mass.size() + 1, 0);
    for (const WeightedEdge& e : edges) {
        if (e.node_a == e.node_b) continue;
        ++graph.offsets[at(e.node_a) + 1];
        ++graph.offsets[at(e.node_b) + 1];
    }
    std::partial_sum(graph.offsets.begin(), graph.offsets.end(), graph.offsets.begin());
    graph.neighbors.resize(at(graph.offsets.back()));
    graph.weights.resize(graph.neighbors.size());
    std::vector<int> next(graph.offsets.begin(), graph.offsets.end() - 1);
    const auto put = [&](int from, int to, double weight) {
        const auto slot = at(next[at(from)]++);
        graph.neighbors[slot] = to;
        graph.weights[slot] = weight;
    };
    for (const WeightedEdge& e : edges) {
        if (e.node_a == e.node_b) continue;
        put(e.node_a, e.node_b, e.weight);
        put(e.node_b, e.node_a, e.weight);
    }
    sort_and_add_up(graph);
    return graph;
}

WeightedGraph induced_subgraph(const WeightedGraph& graph, const std::vector<int>& nodes) {
    WeightedGraph part;
    part.mass.reserve(nodes.size());
    part.offsets.reserve(nodes.size() + 1);
    part.offsets.push_back(0);
    std::vector<int> local(graph.mass.size(), -1);
    for (std::size_t k = 0; k < nodes.size(); ++k) local[at(nodes[k])] = static_cast<int>(k);
    for (const int node : nodes) {
        const auto v = at(node);
        part.mass.push_back(graph.mass[v]);
        for (auto k = at(graph.offsets[v]); k < at(graph.offsets[v + 1]); ++k) {
            const int neighbor = local[at(graph.neighbors[k])];
            if (neighbor < 0) continue;
            part.neighbors.push_back(neighbor);
            part.weights.push_back(graph.weights[k]);
        }
        part.offsets.push_back(static_cast<int>(part.neighbors.size()));
    }
    return part;
}

WeightedGraph contracted_graph(const WeightedGraph& graph, const std::vector<int>& group, int groups) {
    std::vector<double> mass(at(groups), 0.0);
    std::vector<WeightedEdge> edges;
    for (std::size_t v = 0; v < graph.mass.size(); ++v) {
        mass[at(group[v])] += graph.mass[v];
        for (auto k = at(graph.offsets[v]); k < at(graph.offsets[v + 1]); ++k) {
            const auto u = at(graph.neighbors[k]);
            if (v < u && group[v] != group[u]) edges.push_back({group[v], group[u], graph.weights[k]});
        }
    }
    return weighted_graph(std::move(mass), edges);
}

std::vector<int> connected_components(const WeightedGraph& graph) {
    std::vector<int> component(graph.mass.size(), -1);
    std::vector<int> stack;
    int count = 0;
    for (int seed = 0; seed < graph.node_count(); ++seed) {
        if (component[at(seed)] >= 0) continue;
        component[at(seed)] = count;
        stack.assign(1, seed);
        while (!stack.empty()) {
            const auto v = at(stack.back());
            stack.pop_back();
            for (int k = graph.offsets[v]; k < graph.offsets[v + 1]; ++k) {
                const int u = graph.neighbors[at(k)];
                if (component[at(u)] >= 0) continue;
                component[at(u)] = count;
                stack.push_back(u);
            }
        }
        ++count;
    }
    return component;
}

}  // namespace coseg
