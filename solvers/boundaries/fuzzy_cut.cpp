#include "solvers/boundaries/fuzzy_cut.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <queue>
#include <utility>

#include "solvers/boundaries/minimum_cut.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/mesh/connected_pieces.hpp"

namespace coseg {

namespace {

constexpr double smallest_gain = 1e-9;  // in mean edges; cuts of equal capacity leave the labels as they are

using LabelPair = std::pair<int, int>;

std::vector<LabelPair> touching_labels(const DualGraph& graph, const std::vector<int>& label) {
    std::vector<LabelPair> pairs;
    for (const DualEdge& e : graph.edges) {
        const LabelPair pair = std::minmax({label[at(e.face_a)], label[at(e.face_b)]});
        if (!e.is_virtual() && pair.first != pair.second) pairs.push_back(pair);
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
}

/// Calls visit(edge, other face) for the real edges of a face.
template <typename Visit>
void for_each_neighbor(const DualGraph& graph, int face, const Visit& visit) {
    for (int k = graph.offsets[at(face)]; k < graph.offsets[at(face) + 1]; ++k) {
        const int e = graph.incident[at(k)];
        if (!graph.edges[at(e)].is_virtual()) visit(e, graph.other_face(e, face));
    }
}

/// Triangles to the nearest boundary in question, 1 beside it, counted inside each label; 0 for faces it does
/// not reach.
struct BoundaryDistance {
    std::vector<int> of_face;
    std::vector<int> reached;  // faces, by distance
};

/// Boundaries are the real edges for whose two labels `is_boundary` holds.
template <typename IsBoundary>
BoundaryDistance distance_to_boundary(const DualGraph& graph, const std::vector<int>& label,
                                      const IsBoundary& is_boundary) {
    BoundaryDistance distance{.of_face = std::vector<int>(label.size(), 0), .reached = {}};
    const auto reach = [&](int face, int steps) {
        int& known = distance.of_face[at(face)];
        if (known != 0) return;
        known = steps;
        distance.reached.push_back(face);
    };
    for (const DualEdge& e : graph.edges) {
        const int label_a = label[at(e.face_a)];
        const int label_b = label[at(e.face_b)];
        if (e.is_virtual() || !is_boundary(label_a, label_b)) continue;
        reach(e.face_a, 1);
        reach(e.face_b, 1);
    }
    for (std::size_t head = 0; head < distance.reached.size(); ++head) {
        const int face = distance.reached[head];
        const int steps = distance.of_face[at(face)];
        for_each_neighbor(graph, face, [&](int, int other) {
            if (label[at(other)] == label[at(face)]) reach(other, steps + 1);
        });
    }
    return distance;
}

/// Per face whether any cut may move it: within `width` triangles of another label, in the outer half of its
/// region.
std::vector<char> movable_faces(const DualGraph& graph, const std::vector<int>& label, int width) {
    const std::vector<int> distance = distance_to_boundary(graph, label, [](int label_a, int label_b) {
                                          return label_a != label_b;
                                      }).of_face;
    const std::vector<int> region = connected_pieces(graph, label, VirtualEdges::ignored);
    std::vector<int> depth(label.size(), 0);  // per region: distance of its farthest face
    for (std::size_t f = 0; f < label.size(); ++f) {
        int& deepest = depth[at(region[f])];
        deepest = std::max(deepest, distance[f]);
    }
    std::vector<char> movable(label.size(), 0);
    for (std::size_t f = 0; f < label.size(); ++f) {
        const int limit = std::min(width, depth[at(region[f])] / 2);
        movable[f] = distance[f] > 0 && distance[f] <= limit ? 1 : 0;
    }
    return movable;
}

/// The movable faces within `width` triangles of where the two labels meet now, ascending.
std::vector<int> strip_faces(const DualGraph& graph, const std::vector<int>& label,
                             const std::vector<char>& movable, const LabelPair& pair, int width) {
    const BoundaryDistance distance = distance_to_boundary(graph, label, [&](int label_a, int label_b) {
        return LabelPair(std::minmax(label_a, label_b)) == pair;
    });
    std::vector<int> strip;
    for (const int f : distance.reached) {
        const auto face = at(f);
        if (movable[face] != 0 && distance.of_face[face] <= width) strip.push_back(f);
    }
    std::sort(strip.begin(), strip.end());
    return strip;
}

double cost_of_labels(const Eigen::MatrixXd& costs, const std::vector<int>& labels) {
    double sum = 0.0;
    for (Eigen::Index f = 0; f < costs.cols(); ++f) sum += costs(labels[at(f)], f);
    return sum;
}

/// Labels of the strip's faces after the cut, in the strip's order.
std::vector<int> cut_strip(const DualGraph& graph, const std::vector<double>& capacity,
                           const std::vector<int>& label, const Eigen::MatrixXd& costs,
                           const std::vector<int>& strip, LabelPair pair) {
    std::vector<int> node(label.size(), -1);
    for (std::size_t k = 0; k < strip.size(); ++k) node[at(strip[k])] = static_cast<int>(k);
    std::vector<double> to_a(strip.size(), 0.0), to_b(strip.size(), 0.0);
    std::vector<CutArc> arcs;
    for (std::size_t k = 0; k < strip.size(); ++k) {
        if (costs.size() > 0) {
            const double excess = costs(pair.second, strip[k]) - costs(pair.first, strip[k]);
            to_a[k] = std::max(0.0, excess);
            to_b[k] = std::max(0.0, -excess);
        }
        for_each_neighbor(graph, strip[k], [&](int e, int other) {
            const double c = capacity[at(e)];
            const int other_node = node[at(other)];
            const int other_label = label[at(other)];
            if (other_node > static_cast<int>(k)) arcs.push_back({static_cast<int>(k), other_node, c, c});
            if (other_node < 0 && other_label == pair.first) to_a[k] += c;
            if (other_node < 0 && other_label == pair.second) to_b[k] += c;
        });
    }
    const std::vector<char> side = minimum_cut(to_a, to_b, arcs);
    std::vector<int> cut(strip.size());
    std::transform(side.begin(), side.end(), cut.begin(),
                   [&](char s) { return s == 0 ? pair.first : pair.second; });
    return cut;
}

double mean_real_length(const DualGraph& graph) {
    double sum = 0.0;
    double count = 0.0;
    for (const DualEdge& e : graph.edges) {
        if (e.is_virtual()) continue;
        sum += e.length;
        count += 1.0;
    }
    return count > 0.0 ? sum / count : 0.0;
}

/// Distance of every face to the nearest boundary between labels, from centroid to centroid; `limit` where it
/// is more.
std::vector<double> surface_distance(const DualGraph& graph, const FaceGeometry& geometry,
                                     const std::vector<int>& label, double limit) {
    using Entry = std::pair<double, int>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    std::vector<double> distance(label.size(), limit);
    const auto reach = [&](int face, double far) {
        if (far >= distance[at(face)]) return;
        distance[at(face)] = far;
        open.emplace(far, face);
    };
    const auto step = [&](int a, int b) {
        return (geometry.centroid.col(a) - geometry.centroid.col(b)).norm();
    };
    for (const DualEdge& e : graph.edges) {
        if (e.is_virtual()) continue;
        if (label[at(e.face_a)] == label[at(e.face_b)]) continue;
        reach(e.face_a, 0.5 * step(e.face_a, e.face_b));
        reach(e.face_b, 0.5 * step(e.face_a, e.face_b));
    }
    while (!open.empty()) {
        const Entry nearest = open.top();
        open.pop();
        if (nearest.first > distance[at(nearest.second)]) continue;
        for_each_neighbor(graph, nearest.second,
                          [&](int, int other) { reach(other, nearest.first + step(nearest.second, other)); });
    }
    return distance;
}

}  // namespace

std::vector<double> fuzzy_cut_capacities(const DualGraph& graph, const FuzzyCutOptions& options) {
    std::vector<double> angular(graph.edges.size(), 0.0);
    double angular_sum = 0.0;
    double length_sum = 0.0;
    double real_edges = 0.0;
    for (std::size_t e = 0; e < angular.size(); ++e) {
        const DualEdge& edge = graph.edges[e];
        if (edge.is_virtual()) continue;
        const double eta = edge.dihedral < std::numbers::pi ? 1.0 : options.convex_weight;
        angular[e] = eta * (1.0 + std::cos(edge.dihedral));  // the normals' angle is |dihedral - pi|
        angular_sum += angular[e];
        length_sum += edge.length;
        real_edges += 1.0;
    }
    std::vector<double> capacity(angular.size(), 0.0);
    for (std::size_t e = 0; e < capacity.size(); ++e) {
        if (graph.edges[e].is_virtual() || !(length_sum > 0.0)) continue;
        const double relative_bend = angular_sum > 0.0 ? angular[e] * real_edges / angular_sum : 0.0;
        capacity[e] = graph.edges[e].length * real_edges / length_sum / (1.0 + relative_bend);
    }
    return capacity;
}

double boundary_capacity(const DualGraph& graph, const std::vector<double>& capacity,
                         const std::vector<int>& label) {
    double sum = 0.0;
    for (std::size_t e = 0; e < capacity.size(); ++e) {
        const DualEdge& edge = graph.edges[e];
        if (label[at(edge.face_a)] != label[at(edge.face_b)]) sum += capacity[e];
    }
    return sum;
}

std::vector<int> fuzzy_cut(const DualGraph& graph, const std::vector<int>& label,
                           const FuzzyCutOptions& options, const Eigen::MatrixXd& costs) {
    if (costs.size() > 0 && costs.cols() != static_cast<Eigen::Index>(label.size()))
        throw Error(ExitCode::internal, "a fuzzy cut needs one column of costs a face");
    if (options.strip_width < 0 || !(options.convex_weight > 0.0)) {
        throw Error(ExitCode::usage,
                    "a fuzzy cut needs a strip of at least 0 triangles and a convex weight above 0");
    }
    const std::vector<double> capacity = fuzzy_cut_capacities(graph, options);
    const std::vector<char> movable = movable_faces(graph, label, options.strip_width);
    std::vector<int> refined = label;
    const auto cost = [&](const std::vector<int>& labels) {
        return boundary_capacity(graph, capacity, labels) + cost_of_labels(costs, labels);
    };
    for (const LabelPair& pair : touching_labels(graph, label)) {
        const std::vector<int> strip = strip_faces(graph, refined, movable, pair, options.strip_width);
        if (strip.empty()) continue;
        const std::vector<int> cut = cut_strip(graph, capacity, refined, costs, strip, pair);
        std::vector<int> candidate = refined;
        for (std::size_t k = 0; k < strip.size(); ++k) candidate[at(strip[k])] = cut[k];
        if (cost(refined) - cost(candidate) > smallest_gain) refined = std::move(candidate);
    }
    return refined;
}

Eigen::MatrixXd holding_costs(const DualGraph& graph, const FaceGeometry& geometry,
                              const std::vector<int>& label, int labels, double reach) {
    if (!(reach > 0.0)) throw Error(ExitCode::usage, "the reach of a refined boundary must be above 0");
    const double unit = mean_real_length(graph);
    Eigen::MatrixXd cost = Eigen::MatrixXd::Zero(labels, static_cast<Eigen::Index>(label.size()));
    if (!(unit > 0.0)) return cost;
    // The cost of a strip from 0 to x is the integral of 2 t / reach^2 over it: its length times
    // (x / reach)^2.
    const std::vector<double> distance = surface_distance(graph, geometry, label, 2.0 * reach);
    for (Eigen::Index f = 0; f < cost.cols(); ++f) {
        const double leaving = 2.0 * distance[at(f)] * geometry.area[f] / (reach * reach * unit);
        cost.col(f).setConstant(leaving);
        cost(label[at(f)], f) = 0.0;
    }
    return cost;
}

Eigen::MatrixXd score_costs(const DualGraph& graph, const FaceGeometry& geometry,
                            const Eigen::MatrixXd& scores) {
    const double unit = mean_real_length(graph) * std::sqrt(geometry.area.sum());
    if (!(unit > 0.0)) return Eigen::MatrixXd::Zero(scores.rows(), scores.cols());
    return scores * (-1.0 / unit) * geometry.area.matrix().asDiagonal();
}

}  // namespace coseg
