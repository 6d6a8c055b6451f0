#pragma once
// Finds the minimum cut between a source and a sink.

#include <vector>

namespace coseg {

/// The cost of separating two nodes: `capacity` if `from` is on the source side and `to` on the sink side,
/// `reverse_capacity` in the opposite case. Both are >= 0 and finite.
struct CutArc {
    int from = -1;
    int to = -1;
    double capacity = 0.0;
    double reverse_capacity = 0.0;
};

/// Side per node, 0 source, 1 sink, such that the sum of
///     source_capacity[v] over nodes on the sink side, sink_capacity[v] over nodes on the source side, and
///     arcs cut
/// is least. Of several minimum cuts the one with the most nodes on the source side. Capacities are finite
/// and >= 0; they are rounded to 2^-50 of their sum, so that the search works on integers and always ends.
/// Source: Boykov and Kolmogorov 2004 (the search, as in Boost.Graph).
std::vector<char> minimum_cut(const std::vector<double>& source_capacity,
                              const std::vector<double>& sink_capacity, const std::vector<CutArc>& arcs);

}  // namespace coseg
