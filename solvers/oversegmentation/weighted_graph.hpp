#pragma once
// A small undirected graph with masses on its nodes and weights on its edges, and the subgraphs that are made
// of it.

#include <vector>

namespace coseg {

struct WeightedEdge {
    int node_a = -1;
    int node_b = -1;
    double weight = 0.0;
};

/// Both directions of every edge are stored, so that a node's neighbours are one contiguous, ascending run.
struct WeightedGraph {
    std::vector<double> mass;    ///< per node, > 0
    std::vector<int> offsets;    ///< nodes + 1: node v's neighbours are neighbors[offsets[v] .. offsets[v+1])
    std::vector<int> neighbors;  ///< ascending within a node, no loops, no repetitions
    std::vector<double> weights;  ///< > 0, beside `neighbors`

    [[nodiscard]] int node_count() const noexcept { return static_cast<int>(mass.size()); }
};

/// Parallel edges add up in the order given; loops are dropped.
WeightedGraph weighted_graph(std::vector<double> mass, const std::vector<WeightedEdge>& edges);

/// The graph induced by some nodes; its node k is nodes[k]. Nodes must be ascending.
WeightedGraph induced_subgraph(const WeightedGraph& graph, const std::vector<int>& nodes);

/// Makes every group one node: masses and parallel edges add up. `group` per node, 0 .. groups-1.
WeightedGraph contracted_graph(const WeightedGraph& graph, const std::vector<int>& group, int groups);

/// The component of each node. Components are numbered from 0 in the order of their lowest node.
std::vector<int> connected_components(const WeightedGraph& graph);

}  // namespace coseg
