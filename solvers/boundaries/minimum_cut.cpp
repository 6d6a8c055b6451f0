#include "solvers/boundaries/minimum_cut.hpp"

// gcc 12 takes the empty boost::optional in adjacency_list's edge iterators for an uninitialised one.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/boykov_kolmogorov_max_flow.hpp>
#include <cmath>
#include <cstdint>

#include "src/base/index.hpp"

namespace coseg {

namespace {

using Traits = boost::adjacency_list_traits<boost::vecS, boost::vecS, boost::directedS>;

struct NodeData {
    boost::default_color_type color = boost::gray_color;
    Traits::edge_descriptor predecessor{};
    std::size_t distance = 0;
};

struct ArcData {
    std::int64_t capacity = 0;
    std::int64_t residual = 0;
    Traits::edge_descriptor reverse{};
};

using FlowGraph = boost::adjacency_list<boost::vecS, boost::vecS, boost::directedS, NodeData, ArcData>;

void add_arc_pair(FlowGraph& flow, std::size_t from, std::size_t to, std::int64_t capacity,
                  std::int64_t reverse) {
    if (capacity == 0 && reverse == 0) return;
    const auto there = boost::add_edge(from, to, flow).first;
    const auto back = boost::add_edge(to, from, flow).first;
    flow[there].capacity = capacity;
    flow[back].capacity = reverse;
    flow[there].reverse = back;
    flow[back].reverse = there;
}

double sum_of_capacities(const std::vector<double>& source_capacity, const std::vector<double>& sink_capacity,
                         const std::vector<CutArc>& arcs) {
    double sum = 0.0;
    for (const double c : source_capacity) sum += c;
    for (const double c : sink_capacity) sum += c;
    for (const CutArc& arc : arcs) sum += arc.capacity + arc.reverse_capacity;
    return sum;
}

}  // namespace

std::vector<char> minimum_cut(const std::vector<double>& source_capacity,
                              const std::vector<double>& sink_capacity, const std::vector<CutArc>& arcs) {
    const std::size_t nodes = source_capacity.size();
    std::vector<char> side(nodes, 0);
    const double sum = sum_of_capacities(source_capacity, sink_capacity, arcs);
    if (!(sum > 0.0)) return side;
    const auto whole = [&](double capacity) {
        return static_cast<std::int64_t>(std::llround(capacity / sum * 0x1p50));
    };
    FlowGraph flow(nodes + 2);
    const std::size_t source = nodes;
    const std::size_t sink = nodes + 1;
    for (std::size_t v = 0; v < nodes; ++v) {
        add_arc_pair(flow, source, v, whole(source_capacity[v]), 0);
        add_arc_pair(flow, v, sink, whole(sink_capacity[v]), 0);
    }
    for (const CutArc& arc : arcs) {
        add_arc_pair(flow, at(arc.from), at(arc.to), whole(arc.capacity), whole(arc.reverse_capacity));
    }
    boost::boykov_kolmogorov_max_flow(flow, get(&ArcData::capacity, flow), get(&ArcData::residual, flow),
                                      get(&ArcData::reverse, flow), get(&NodeData::predecessor, flow),
                                      get(&NodeData::color, flow), get(&NodeData::distance, flow),
                                      get(boost::vertex_index, flow), source, sink);
    for (std::size_t v = 0; v < nodes; ++v) side[v] = flow[v].color == boost::white_color ? 1 : 0;
    return side;
}

}  // namespace coseg
