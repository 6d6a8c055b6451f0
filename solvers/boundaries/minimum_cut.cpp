#include "solvers/boundaries/minimum_cut.hpp"

#include <boost/graph/boykov_kolmogorov_max_flow.hpp>
#include <boost/graph/compressed_sparse_row_graph.hpp>
#include <cmath>
#include <cstdint>
#include <utility>

namespace coseg {

namespace {

/// Arcs lie in one array, by the node that they leave, because thousands of small graphs are cut one after
/// the other: an adjacency list asks for memory for each of their arcs, which takes longer than the search.
using Graph = boost::compressed_sparse_row_graph<boost::directedS, boost::no_property, boost::no_property,
                                                 boost::no_property, std::uint32_t, std::uint32_t>;
using Arc = boost::graph_traits<Graph>::edge_descriptor;

/// Two arcs between the same nodes, one in each direction.
struct ArcPair {
    std::uint32_t from = 0;
    std::uint32_t to = 0;
    std::int64_t capacity = 0;
    std::int64_t reverse = 0;
};

class FlowNetwork {
  public:
    FlowNetwork(std::size_t nodes, const std::vector<ArcPair>& pairs)
        : capacity_(2 * pairs.size()), residual_(2 * pairs.size()), reverse_(2 * pairs.size()) {
        std::vector<std::uint32_t> next(nodes + 1, 0);  // of each node: where its next arc lies
        for (const ArcPair& pair : pairs) {
            ++next[pair.from + 1];
            ++next[pair.to + 1];
        }
        for (std::size_t v = 0; v < nodes; ++v) next[v + 1] += next[v];
        std::vector<std::pair<std::uint32_t, std::uint32_t>> ends(2 * pairs.size());
        for (const ArcPair& pair : pairs) {
            const Arc there(pair.from, next[pair.from]++);
            const Arc back(pair.to, next[pair.to]++);
            ends[there.idx] = {pair.from, pair.to};
            ends[back.idx] = {pair.to, pair.from};
            capacity_[there.idx] = pair.capacity;
            capacity_[back.idx] = pair.reverse;
            reverse_[there.idx] = back;
            reverse_[back.idx] = there;
        }
        graph_ = Graph(boost::edges_are_sorted, ends.begin(), ends.end(), static_cast<std::uint32_t>(nodes));
    }

    /// Of each node, after the search: white where it still reaches the sink.
    [[nodiscard]] std::vector<boost::default_color_type> search(std::uint32_t source, std::uint32_t sink) {
        const auto arc_number = get(boost::edge_index, graph_);
        const auto node_number = get(boost::vertex_index, graph_);
        const std::size_t nodes = num_vertices(graph_);
        std::vector<boost::default_color_type> color(nodes, boost::gray_color);
        std::vector<Arc> predecessor(nodes);
        std::vector<std::size_t> distance(nodes);
        boost::boykov_kolmogorov_max_flow(
            graph_, boost::make_iterator_property_map(capacity_.begin(), arc_number),
            boost::make_iterator_property_map(residual_.begin(), arc_number),
            boost::make_iterator_property_map(reverse_.begin(), arc_number),
            boost::make_iterator_property_map(predecessor.begin(), node_number),
            boost::make_iterator_property_map(color.begin(), node_number),
            boost::make_iterator_property_map(distance.begin(), node_number), node_number, source, sink);
        return color;
    }

  private:
    Graph graph_;
    std::vector<std::int64_t> capacity_;
    std::vector<std::int64_t> residual_;
    std::vector<Arc> reverse_;
};

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
    const auto source = static_cast<std::uint32_t>(nodes);
    const auto sink = static_cast<std::uint32_t>(nodes + 1);
    std::vector<ArcPair> pairs;
    pairs.reserve(2 * nodes + arcs.size());
    const auto add = [&](ArcPair pair) {
        if (pair.capacity != 0 || pair.reverse != 0) pairs.push_back(pair);
    };
    for (std::uint32_t v = 0; v < source; ++v) {
        add({source, v, whole(source_capacity[v]), 0});
        add({v, sink, whole(sink_capacity[v]), 0});
    }
    for (const CutArc& arc : arcs)
        add({static_cast<std::uint32_t>(arc.from), static_cast<std::uint32_t>(arc.to), whole(arc.capacity),
             whole(arc.reverse_capacity)});
    const std::vector<boost::default_color_type> color = FlowNetwork(nodes + 2, pairs).search(source, sink);
    for (std::size_t v = 0; v < nodes; ++v) side[v] = color[v] == boost::white_color ? 1 : 0;
    return side;
}

}  // namespace coseg
