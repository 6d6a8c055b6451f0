#include "src/shortest_paths.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <functional>
#include <limits>

namespace coseg {

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

std::span<const SurfaceArc> arcs_of(const SurfaceGraph& graph, int node) {
    const int begin = graph.offsets[static_cast<std::size_t>(node)];
    const int end = graph.offsets[static_cast<std::size_t>(node) + 1];
    return {graph.arcs.data() + begin, static_cast<std::size_t>(end - begin)};
}

/// A binary heap of (distance, node), nearest first. The bits of nonnegative floats are ordered as the floats
/// are, so one integer comparison orders both.
class NodeQueue {
  public:
    [[nodiscard]] bool empty() const { return keys_.empty(); }
    void push(float distance, int node) {
        keys_.push_back(std::uint64_t{std::bit_cast<std::uint32_t>(distance)} << 32U |
                        static_cast<std::uint32_t>(node));
        std::push_heap(keys_.begin(), keys_.end(), std::greater<>());
    }
    PathSource pop() {
        std::pop_heap(keys_.begin(), keys_.end(), std::greater<>());
        const std::uint64_t key = keys_.back();
        keys_.pop_back();
        return {static_cast<int>(key & 0xffffffffU),
                std::bit_cast<float>(static_cast<std::uint32_t>(key >> 32U))};
    }

  private:
    std::vector<std::uint64_t> keys_;
};

/// Which nodes must be looked at again because a neighbour came closer.
class PendingNodes {
  public:
    explicit PendingNodes(int nodes) : flags_(static_cast<std::size_t>(nodes), 0) {}
    [[nodiscard]] bool any() const { return count_ > 0; }
    void add_neighbours(const SurfaceGraph& graph, int node) {
        for (const SurfaceArc& arc : arcs_of(graph, node)) {
            unsigned char& flag = flags_[static_cast<std::size_t>(arc.node)];
            count_ += 1 - flag;
            flag = 1;
        }
    }
    bool take(int node) {
        unsigned char& flag = flags_[static_cast<std::size_t>(node)];
        if (flag == 0) return false;
        flag = 0;
        --count_;
        return true;
    }

  private:
    std::vector<unsigned char> flags_;
    int count_ = 0;
};

/// d(v) = min(d(v), min over arcs d(u) + length) in every lane; true if any lane changed.
bool relax(const SurfaceGraph& graph, int node, std::vector<PathLanes>& distance) {
    PathLanes& mine = distance[static_cast<std::size_t>(node)];
    PathLanes best = mine;
    for (const SurfaceArc& arc : arcs_of(graph, node)) {
        best = best.min(distance[static_cast<std::size_t>(arc.node)] + arc.length);
    }
    if ((best == mine).all()) return false;
    mine = best;
    return true;
}

void sweep(const SurfaceGraph& graph, std::span<const int> order, std::vector<PathLanes>& distance,
           PendingNodes& pending) {
    for (const int node : order) {
        if (pending.take(node) && relax(graph, node, distance)) pending.add_neighbours(graph, node);
    }
}

}  // namespace

std::vector<int> lower_distances(const SurfaceGraph& graph, std::span<const PathSource> sources,
                                 std::vector<float>& distance) {
    std::vector<int> settled;
    NodeQueue queue;
    const auto offer = [&](int node, float candidate) {
        float& known = distance[static_cast<std::size_t>(node)];
        if (!(candidate < known)) return;
        known = candidate;
        queue.push(candidate, node);
    };
    for (const PathSource& source : sources) offer(source.node, source.distance);
    while (!queue.empty()) {
        const PathSource nearest = queue.pop();
        if (nearest.distance > distance[static_cast<std::size_t>(nearest.node)]) continue;
        settled.push_back(nearest.node);
        for (const SurfaceArc& arc : arcs_of(graph, nearest.node))
            offer(arc.node, nearest.distance + arc.length);
    }
    return settled;
}

void path_distances(const SurfaceGraph& graph, std::span<const std::vector<PathSource>, path_lanes> sources,
                    std::span<const int> order, std::vector<PathLanes>& distance) {
    distance.assign(static_cast<std::size_t>(graph.node_count()), PathLanes::Constant(infinity));
    PendingNodes pending(graph.node_count());
    for (int lane = 0; lane < path_lanes; ++lane) {
        for (const PathSource& source : sources[static_cast<std::size_t>(lane)]) {
            float& known = distance[static_cast<std::size_t>(source.node)][lane];
            known = std::min(known, source.distance);
            pending.add_neighbours(graph, source.node);
        }
    }
    const std::vector<int> backwards(order.rbegin(), order.rend());
    while (pending.any()) {
        sweep(graph, backwards, distance, pending);
        sweep(graph, order, distance, pending);
    }
}

}  // namespace coseg
