#include "src/mesh/spanning_joins.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

#include "src/base/disjoint_sets.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

constexpr int leaf_points = 8;
constexpr int mixed = -1;

/// Points in the order of a k-d tree; a node is a run of that order.
struct Node {
    Eigen::Vector3d low, high;  // bounding box
    int begin, end;
    int left = -1, right = -1;  // -1 at a leaf
    int group = mixed;          // the group of all points below, or `mixed`
};

struct PointTree {
    std::vector<int> order;
    Eigen::Matrix3Xd points;  // in tree order
    std::vector<Node> nodes;  // children after their parent
};

int build_node(const Eigen::Matrix3Xd& points, PointTree& tree, int begin, int end) {
    Node node{points.col(tree.order[at(begin)]), {}, begin, end};
    node.high = node.low;
    for (int i = begin; i < end; ++i) {
        const Eigen::Vector3d p = points.col(tree.order[at(i)]);
        node.low = node.low.cwiseMin(p);
        node.high = node.high.cwiseMax(p);
    }
    const int index = static_cast<int>(tree.nodes.size());
    tree.nodes.push_back(node);
    if (end - begin <= leaf_points) return index;

    int axis = 0;
    (node.high - node.low).maxCoeff(&axis);
    const int middle = begin + (end - begin) / 2;
    const auto first = tree.order.begin();
    std::nth_element(first + begin, first + middle, first + end, [&](int x, int y) {
        return std::pair{points(axis, x), x} < std::pair{points(axis, y), y};
    });
    const int left = build_node(points, tree, begin, middle);
    const int right = build_node(points, tree, middle, end);
    tree.nodes[at(index)].left = left;
    tree.nodes[at(index)].right = right;
    return index;
}

PointTree build_tree(const Eigen::Matrix3Xd& points) {
    PointTree tree;
    tree.order.resize(at(points.cols()));
    std::iota(tree.order.begin(), tree.order.end(), 0);
    build_node(points, tree, 0, static_cast<int>(points.cols()));
    tree.points.resize(3, points.cols());
    for (std::size_t i = 0; i < tree.order.size(); ++i) {
        tree.points.col(static_cast<Eigen::Index>(i)) = points.col(tree.order[i]);
    }
    return tree;
}

/// group: of the points in tree order. Children come after their parent, so one backward pass suffices.
void tag_nodes(PointTree& tree, const std::vector<int>& group) {
    for (auto node = tree.nodes.rbegin(); node != tree.nodes.rend(); ++node) {
        if (node->left >= 0) {
            const int left = tree.nodes[at(node->left)].group;
            const int right = tree.nodes[at(node->right)].group;
            node->group = left == right ? left : mixed;
        } else {
            const auto first = group.begin() + node->begin;
            const bool one =
                std::all_of(first, group.begin() + node->end, [&](int g) { return g == *first; });
            node->group = one ? *first : mixed;
        }
    }
}

/// Ordered by distance, then by the points: a total order, without which Boruvka's rounds could close a
/// cycle.
struct Candidate {
    double squared = std::numeric_limits<double>::infinity();
    int point_a = std::numeric_limits<int>::max();
    int point_b = std::numeric_limits<int>::max();
    friend bool operator<(const Candidate& x, const Candidate& y) {
        return std::tie(x.squared, x.point_a, x.point_b) < std::tie(y.squared, y.point_a, y.point_b);
    }
};

double squared_distance_to_box(const Node& node, const Eigen::Vector3d& p) {
    return (node.low - p).cwiseMax(p - node.high).cwiseMax(0.0).squaredNorm();
}

/// Looks for points of other groups that are nearer to one point than the best candidate of its group.
class ForeignSearch {
  public:
    ForeignSearch(const PointTree& tree, const std::vector<int>& group) : tree_(tree), group_(group) {}

    void improve(int point, Candidate& best) {
        point_ = point;
        at_ = tree_.points.col(point);
        visit(0, squared_distance_to_box(tree_.nodes[0], at_), best);
    }

  private:
    void visit(int index, double squared, Candidate& best) {
        const Node& node = tree_.nodes[at(index)];
        if (squared > best.squared || node.group == group_[at(point_)]) return;
        if (node.left < 0) return visit_leaf(node, best);
        const double left = squared_distance_to_box(tree_.nodes[at(node.left)], at_);
        const double right = squared_distance_to_box(tree_.nodes[at(node.right)], at_);
        if (left <= right) {
            visit(node.left, left, best);
            visit(node.right, right, best);
        } else {
            visit(node.right, right, best);
            visit(node.left, left, best);
        }
    }

    void visit_leaf(const Node& node, Candidate& best) const {
        const int mine = tree_.order[at(point_)];
        for (int i = node.begin; i < node.end; ++i) {
            if (group_[at(i)] == group_[at(point_)]) continue;
            const int other = tree_.order[at(i)];
            const Candidate found{(tree_.points.col(i) - at_).squaredNorm(), std::min(mine, other),
                                  std::max(mine, other)};
            best = std::min(best, found);
        }
    }

    const PointTree& tree_;
    const std::vector<int>& group_;
    int point_ = 0;
    Eigen::Vector3d at_ = Eigen::Vector3d::Zero();
};

/// The best candidate of every group. `nearest`: per point a lower bound of the squared distance to any other
/// group; groups only grow, so it stays valid from round to round.
std::vector<Candidate> best_candidates(const PointTree& tree, const std::vector<int>& group, int groups,
                                       std::vector<double>& nearest) {
    std::vector<Candidate> best(at(groups));
    ForeignSearch search(tree, group);
    for (std::size_t i = 0; i < group.size(); ++i) {
        Candidate& candidate = best[at(group[i])];
        if (nearest[i] > candidate.squared) continue;
        search.improve(static_cast<int>(i), candidate);
        nearest[i] = candidate.squared;
    }
    return best;
}

/// Takes each group's candidate unless its two ends are joined already (both ends may propose the same pair).
void take(const std::vector<Candidate>& best, const std::vector<int>& group_of_point, DisjointSets& sets,
          std::vector<PointJoin>& joins) {
    for (const Candidate& c : best) {
        if (c.point_b == std::numeric_limits<int>::max()) continue;  // no longer a group of its own
        if (!sets.join(group_of_point[at(c.point_a)], group_of_point[at(c.point_b)])) continue;
        joins.push_back({c.point_a, c.point_b, std::sqrt(c.squared)});
    }
}

}  // namespace

std::vector<PointJoin> spanning_joins(const Eigen::Matrix3Xd& points, const std::vector<int>& group,
                                      int groups) {
    std::vector<PointJoin> joins;
    if (groups <= 1) return joins;
    PointTree tree = build_tree(points);
    DisjointSets sets(at(groups));
    std::vector<int> merged(group.size());
    std::vector<double> nearest(group.size(), 0.0);
    while (static_cast<int>(joins.size()) + 1 < groups) {
        for (std::size_t i = 0; i < merged.size(); ++i) {
            merged[i] = sets.lowest(group[at(tree.order[i])]);
        }
        tag_nodes(tree, merged);
        const std::size_t before = joins.size();
        take(best_candidates(tree, merged, groups, nearest), group, sets, joins);
        if (joins.size() == before) {
            throw Error(ExitCode::internal,
                        "components cannot be joined: a face centroid is not a finite point");
        }
    }
    std::sort(joins.begin(), joins.end(), [](const PointJoin& x, const PointJoin& y) {
        return std::pair{x.point_a, x.point_b} < std::pair{y.point_a, y.point_b};
    });
    return joins;
}

}  // namespace coseg
