#include "src/geodesics/shortest_paths.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>

#include "src/base/index.hpp"
#include "src/base/vector_clones.hpp"

namespace coseg {

namespace {

/// The distance of a node that no path has reached.
constexpr float unreached = std::numeric_limits<float>::infinity();

std::span<const SurfaceArc> arcs_of(const SurfaceGraph& graph, int node) {
    const int begin = graph.offsets[at(node)];
    const int end = graph.offsets[at(node) + 1];
    return {graph.arcs.data() + begin, at(end - begin)};
}

/// A radix heap (Ahuja, Mehlhorn, Orlin, Tarjan 1990), nearest first: what is pushed is never nearer than
/// what was popped last. The bits of nonnegative floats are ordered as the floats are; a bucket holds what
/// differs from the last one popped first in the same bit.
class NodeQueue {
  public:
    void push(float distance, int node) { put({std::bit_cast<std::uint32_t>(distance), node}); }
    /// False if there is none left.
    bool pop(PathSource& nearest) {
        if (buckets_[0].empty() && !refill()) return false;
        const Entry entry = buckets_[0].back();
        buckets_[0].pop_back();
        nearest = {entry.node, std::bit_cast<float>(entry.key)};
        return true;
    }

  private:
    struct Entry {
        std::uint32_t key;
        int node;
    };
    void put(Entry entry) { buckets_[at(std::bit_width(entry.key ^ last_))].push_back(entry); }
    /// Spreads the first bucket that is not empty over those before it.
    bool refill() {
        const auto full =
            std::find_if(buckets_.begin(), buckets_.end(), [](const auto& b) { return !b.empty(); });
        if (full == buckets_.end()) return false;
        last_ = std::min_element(full->begin(), full->end(), [](const Entry& x, const Entry& y) {
                    return x.key < y.key;
                })->key;
        for (const Entry& entry : *full) put(entry);
        full->clear();
        return true;
    }

    std::array<std::vector<Entry>, 33> buckets_;
    std::uint32_t last_ = 0;
};

/// Offers the distances of every node that have become smaller to its neighbours, in all lanes at once.
/// `is_pending` marks the nodes whose neighbours have not been told. Returns by how many the marks became
/// more.
COSEG_VECTOR_CLONES int sweep(const SurfaceGraph& graph, std::span<const int> order, PathLanes* distances,
                              unsigned char* is_pending) {
    int more = 0;
    for (const int node : order) {
        if (is_pending[node] == 0) continue;
        is_pending[node] = 0;
        --more;
        std::array<float, path_lanes> mine{};
        std::copy_n(distances[node].data(), mine.size(), mine.begin());
        for (const SurfaceArc& arc : arcs_of(graph, node)) {
            float* known = distances[arc.node].data();
            const float length = arc.length;
            int nearer = 0;
            COSEG_LANES_LOOP
            for (std::size_t l = 0; l < mine.size(); ++l) {
                const float offered = mine[l] + length;
                nearer |= offered < known[l] ? 1 : 0;
                known[l] = offered < known[l] ? offered : known[l];
            }
            const int before = is_pending[arc.node];
            is_pending[arc.node] = static_cast<unsigned char>(before | nearer);
            more += (before | nearer) - before;
        }
    }
    return more;
}

/// Passes there and back. Where paths wind against `order`, only the number of nodes bounds what they would
/// need, and single searches are then faster.
constexpr int most_passes = 200;

/// The same distances by one search for each lane.
void lower_each_lane(const SurfaceGraph& graph, std::span<const std::vector<PathSource>, path_lanes> sources,
                     std::vector<PathLanes>& distance) {
    std::vector<float> of_lane(distance.size());
    for (int lane = 0; lane < path_lanes; ++lane) {
        std::fill(of_lane.begin(), of_lane.end(), unreached);
        lower_distances(graph, sources[at(lane)], of_lane);
        for (std::size_t v = 0; v < distance.size(); ++v) distance[v][lane] = of_lane[v];
    }
}

}  // namespace

std::vector<int> lower_distances(const SurfaceGraph& graph, std::span<const PathSource> sources,
                                 std::vector<float>& distance) {
    std::vector<int> settled;
    NodeQueue queue;
    const auto offer = [&](int node, float candidate) {
        float& known = distance[at(node)];
        if (!(candidate < known)) return;
        known = candidate;
        queue.push(candidate, node);
    };
    for (const PathSource& source : sources) offer(source.node, source.distance);
    for (PathSource nearest; queue.pop(nearest);) {
        if (nearest.distance > distance[at(nearest.node)]) continue;
        settled.push_back(nearest.node);
        for (const SurfaceArc& arc : arcs_of(graph, nearest.node))
            offer(arc.node, nearest.distance + arc.length);
    }
    return settled;
}

void path_distances(const SurfaceGraph& graph, std::span<const std::vector<PathSource>, path_lanes> sources,
                    std::span<const int> order, std::vector<PathLanes>& distance) {
    distance.assign(at(graph.node_count()), PathLanes::Constant(unreached));
    std::vector<unsigned char> is_pending(distance.size(), 0);
    for (int lane = 0; lane < path_lanes; ++lane) {
        for (const PathSource& source : sources[at(lane)]) {
            float& known = distance[at(source.node)][lane];
            known = std::min(known, source.distance);
            is_pending[at(source.node)] = 1;
        }
    }
    auto pending = static_cast<int>(std::count(is_pending.begin(), is_pending.end(), 1));
    const std::vector<int> backwards(order.rbegin(), order.rend());
    for (int pass = 0; pending > 0 && pass < most_passes; ++pass) {
        pending += sweep(graph, backwards, distance.data(), is_pending.data());
        pending += sweep(graph, order, distance.data(), is_pending.data());
    }
    if (pending > 0) lower_each_lane(graph, sources, distance);
}

}  // namespace coseg
