#include "solvers/oversegmentation/oversegmentation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <queue>
#include <tuple>
#include <utility>

#include "solvers/oversegmentation/face_agglomeration.hpp"
#include "solvers/oversegmentation/fiedler_cut.hpp"
#include "solvers/oversegmentation/weighted_graph.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/base/seeded_random.hpp"
#include "src/mesh/dihedral_cost.hpp"

namespace coseg {

namespace {

// Lengths and areas below this share of their mean count as that much: degenerate faces stay in the graph,
// connected and with a finite cut / area.
constexpr double smallest_share = 1e-6;
// Regions below this share of the mean area of a patch are crumbs, which are cut off first, as their borders
// are short. They do not count as patches where they use up so many that one is left with more than
// `large_patch` times the mean area.
constexpr double crumb_share = 0.05;
constexpr double large_patch = 8.0;
// Cuts for each patch asked for, at most: shapes of nothing but crumbs are left with them.
constexpr int most_cuts = 10;

double edge_noise(const DualEdge& edge, std::uint64_t seed) {
    const auto a = static_cast<std::uint64_t>(edge.is_virtual() ? edge.face_a : edge.vertex_a);
    const auto b = static_cast<std::uint64_t>(edge.is_virtual() ? edge.face_b : edge.vertex_b);
    return normal_of(hash_words({seed, edge.is_virtual() ? 1U : 0U, a, b}));
}

WeightedGraph noisy_face_graph(const FaceGeometry& geometry, const DualGraph& graph, double noise,
                               std::uint64_t seed) {
    double mean_length = 0.0;
    for (const DualEdge& e : graph.edges) mean_length += e.length / static_cast<double>(graph.edges.size());
    const double smallest_length = mean_length > 0.0 ? smallest_share * mean_length : 1.0;
    std::vector<WeightedEdge> edges;
    edges.reserve(graph.edges.size());
    for (const DualEdge& e : graph.edges) {
        const double factor = noise > 0.0 ? std::exp(noise * edge_noise(e, seed)) : 1.0;
        edges.push_back(
            {e.face_a, e.face_b, std::max(e.length, smallest_length) * dihedral_cost(e) * factor});
    }
    const double smallest_area =
        geometry.total_area > 0.0 ? smallest_share * geometry.total_area / graph.face_count : 1.0;
    std::vector<double> mass(at(graph.face_count));
    for (int f = 0; f < graph.face_count; ++f) {
        mass[at(f)] = std::max(geometry.area[f], smallest_area);
    }
    return weighted_graph(std::move(mass), edges);
}

/// A connected set of nodes with its best cut, found once and kept until the region is the next to be cut.
struct Region {
    std::vector<int> nodes;  // ascending
    double mass = 0.0;       // 0 once it is cut
    bool is_crumb = false;
    TwoWayCut cut;  // of induced_subgraph(nodes); value infinite for a crumb and for a single node
};

Region region_of(const WeightedGraph& graph, std::vector<int> nodes, double crumb) {
    double mass = 0.0;
    for (const int v : nodes) mass += graph.mass[at(v)];
    Region region{.nodes = std::move(nodes), .mass = mass, .is_crumb = mass < crumb, .cut = {}};
    if (region.nodes.size() > 1 && !region.is_crumb) {
        region.cut = fiedler_cut(induced_subgraph(graph, region.nodes));
    } else {
        region.cut.value = std::numeric_limits<double>::infinity();
    }
    return region;
}

/// The connected pieces of both sides of the region's cut, by lowest node.
std::vector<std::vector<int>> pieces_of_cut(const WeightedGraph& graph, const Region& region) {
    std::vector<std::vector<int>> pieces;
    for (const int side : {0, 1}) {
        std::vector<int> nodes;
        for (std::size_t k = 0; k < region.nodes.size(); ++k) {
            if (region.cut.side[k] == side) nodes.push_back(region.nodes[k]);
        }
        const std::vector<int> component = connected_components(induced_subgraph(graph, nodes));
        const auto first = pieces.size();
        for (std::size_t k = 0; k < nodes.size(); ++k) {
            const auto piece = first + at(component[k]);
            if (piece == pieces.size()) pieces.emplace_back();
            pieces[piece].push_back(nodes[k]);
        }
    }
    return pieces;
}

/// Cuts a graph into connected regions, the one with the best cut first.
class RecursiveCuts {
  public:
    explicit RecursiveCuts(const WeightedGraph& graph) : graph_(graph) {
        std::vector<std::vector<int>> pieces;
        const std::vector<int> component = connected_components(graph);
        for (int v = 0; v < graph.node_count(); ++v) {
            const auto c = at(component[at(v)]);
            if (c == pieces.size()) pieces.emplace_back();
            pieces[c].push_back(v);
        }
        waiting_ = std::move(pieces);
    }

    /// Goes on until there are `target` regions of at least the mass `crumb`, or nothing is left to cut, or
    /// `most` cuts have been made.
    void cut(int target, double crumb, int most) {
        take_up(crumb);
        for (int cuts = 0; cuts < most && whole_ < target && can_cut(); ++cuts) {
            Region& chosen = regions_[at(next_.top())];
            next_.pop();
            --whole_;
            chosen.mass = 0.0;
            waiting_ = pieces_of_cut(graph_, chosen);
            take_up(crumb);
        }
    }

    [[nodiscard]] double largest() const {
        double mass = 0.0;
        for (const Region& region : regions_) mass = std::max(mass, region.mass);
        return mass;
    }

    [[nodiscard]] int count() const { return static_cast<int>(next_.size()); }

    /// Of each node.
    [[nodiscard]] std::vector<int> regions() && {
        std::vector<int> region_of_node(graph_.mass.size(), -1);
        for (; !next_.empty(); next_.pop()) {
            for (const int v : regions_[at(next_.top())].nodes) region_of_node[at(v)] = next_.top();
        }
        return region_of_node;
    }

  private:
    struct Later {
        const std::vector<Region>& regions;
        bool operator()(int a, int b) const {
            const Region& x = regions[at(a)];
            const Region& y = regions[at(b)];
            return std::tie(x.cut.value, x.nodes.front()) > std::tie(y.cut.value, y.nodes.front());
        }
    };

    void take_up(double crumb) {
        for (std::vector<int>& nodes : waiting_) {
            regions_.push_back(region_of(graph_, std::move(nodes), crumb));
            whole_ += regions_.back().is_crumb ? 0 : 1;
            next_.push(static_cast<int>(regions_.size()) - 1);
        }
        waiting_.clear();
    }

    [[nodiscard]] bool can_cut() const { return std::isfinite(regions_[at(next_.top())].cut.value); }

    const WeightedGraph& graph_;
    std::vector<std::vector<int>> waiting_;
    std::vector<Region> regions_;
    std::priority_queue<int, std::vector<int>, Later> next_{Later{regions_}};
    int whole_ = 0;  ///< regions in the queue that are no crumbs
};

/// Region number per node: at least min(target, nodes) regions, all connected. Where one of them is large,
/// `target` are no crumbs, as far as the cuts suffice.
std::vector<int> recursive_cuts(const WeightedGraph& graph, int target) {
    const double mean = std::accumulate(graph.mass.begin(), graph.mass.end(), 0.0) / target;
    const int least = std::min(target, graph.node_count());
    RecursiveCuts cuts(graph);
    cuts.cut(least, 0.0, least);
    if (cuts.largest() > large_patch * mean) {
        RecursiveCuts without_crumbs(graph);
        without_crumbs.cut(target, crumb_share * mean, most_cuts * target);
        if (without_crumbs.count() >= least) return std::move(without_crumbs).regions();
    }
    return std::move(cuts).regions();
}

/// Numbers 0.. by first occurrence; returns how many there are.
int renumber(std::vector<int>& labels) {
    std::vector<int> number;
    int count = 0;
    for (int& label : labels) {
        const auto old = at(label);
        if (old >= number.size()) number.resize(old + 1, -1);
        if (number[old] < 0) number[old] = count++;
        label = number[old];
    }
    return count;
}

/// Neighbour with the largest shared weight (ties: lowest number); -1 if there is none.
int closest_neighbor(const WeightedGraph& graph, int node) {
    int closest = -1;
    double largest = 0.0;
    const auto v = at(node);
    for (auto k = at(graph.offsets[v]); k < at(graph.offsets[v + 1]); ++k) {
        if (graph.weights[k] <= largest) continue;
        largest = graph.weights[k];
        closest = graph.neighbors[k];
    }
    return closest;
}

/// Until `target` regions are left, the smallest that has a neighbour goes to its closest one.
void merge_smallest(const WeightedGraph& graph, std::vector<int>& region_of_node, int target) {
    for (int count = renumber(region_of_node); count > target; count = renumber(region_of_node)) {
        const WeightedGraph quotient = contracted_graph(graph, region_of_node, count);
        int smallest = -1;
        for (int r = 0; r < count; ++r) {
            if (closest_neighbor(quotient, r) < 0) continue;
            if (smallest < 0 || quotient.mass[at(r)] < quotient.mass[at(smallest)]) {
                smallest = r;
            }
        }
        if (smallest < 0) return;
        std::replace(region_of_node.begin(), region_of_node.end(), smallest,
                     closest_neighbor(quotient, smallest));
    }
}

}  // namespace

std::vector<int> oversegment(const FaceGeometry& geometry, const DualGraph& graph,
                             const OversegmentationOptions& options, std::uint64_t seed) {
    if (options.patches < 1 || !(options.noise >= 0.0)) {
        throw Error(ExitCode::usage, "an over-segmentation needs at least 1 patch and a noise of at least 0");
    }
    std::vector<int> patch(at(graph.face_count));
    std::iota(patch.begin(), patch.end(), 0);
    if (graph.face_count <= options.patches) return patch;
    const WeightedGraph faces = noisy_face_graph(geometry, graph, options.noise, seed);
    std::vector<int> super_face = agglomerate(faces, std::max(options.super_faces, options.patches));
    const int super_faces = *std::max_element(super_face.begin(), super_face.end()) + 1;
    const std::vector<int> place = elimination_places(contracted_graph(faces, super_face, super_faces));
    for (int& s : super_face) s = place[at(s)];
    const WeightedGraph super_graph = contracted_graph(faces, super_face, super_faces);
    std::vector<int> region = recursive_cuts(super_graph, options.patches);
    merge_smallest(super_graph, region, options.patches);
    for (std::size_t f = 0; f < patch.size(); ++f) patch[f] = region[at(super_face[f])];
    renumber(patch);
    return patch;
}

}  // namespace coseg
