#include "src/measures/part_borders.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <tuple>
#include <utility>

#include "src/base/index.hpp"
#include "src/mesh/half_edges.hpp"

namespace coseg {

namespace {

/// An edge of the border, in the direction in which the face of the lower part runs along it.
struct BorderEdge {
    int part_a;
    int part_b;
    int from;
    int to;
    [[nodiscard]] auto key() const { return std::tuple(part_a, part_b, from, to); }
    [[nodiscard]] bool is_of_same_parts(const BorderEdge& other) const {
        return part_a == other.part_a && part_b == other.part_b;
    }
};

std::vector<BorderEdge> border_edges(const TriMesh& mesh, const std::vector<int>& part_of_face) {
    std::vector<BorderEdge> edges;
    const std::vector<HalfEdge> sides = sorted_half_edges(mesh);
    for (std::size_t k = 1; k < sides.size(); ++k) {
        if (!share_edge(sides[k - 1], sides[k])) continue;
        const int before = part_of_face[at(sides[k - 1].face)];
        const int now = part_of_face[at(sides[k].face)];
        if (before == now) continue;
        const HalfEdge& side = before < now ? sides[k - 1] : sides[k];
        edges.push_back({std::min(before, now), std::max(before, now), side.forward ? side.low : side.high,
                         side.forward ? side.high : side.low});
    }
    std::sort(edges.begin(), edges.end(),
              [](const BorderEdge& x, const BorderEdge& y) { return x.key() < y.key(); });
    return edges;
}

/// Joins the edges of one pair of parts to curves.
class CurveTracer {
  public:
    /// `degree`: per vertex the number of border edges of all parts.
    CurveTracer(const TriMesh& mesh, const std::map<int, int>& degree, std::vector<BorderEdge> edges)
        : mesh_(mesh), degree_(degree), edges_(std::move(edges)), is_taken_(edges_.size(), 0) {
        for (std::size_t k = 0; k < edges_.size(); ++k) first_from_.try_emplace(edges_[k].from, k);
    }

    std::vector<BorderCurve> run() {
        for (const bool begins_at_ends : {true, false}) {
            for (std::size_t k = 0; k < edges_.size(); ++k) {
                if (is_taken_[k] == 0 && (!begins_at_ends || is_end(edges_[k].from))) trace(k);
            }
        }
        return std::move(curves_);
    }

  private:
    [[nodiscard]] bool is_end(int vertex) const {
        return degree_.at(vertex) != 2 || !first_from_.contains(vertex);
    }

    void trace(std::size_t edge) {
        BorderCurve curve{edges_[edge].part_a, edges_[edge].part_b, false, {edges_[edge].from}, 0.0};
        while (true) {
            const BorderEdge& now = edges_[edge];
            is_taken_[edge] = 1;
            curve.length += (mesh_.vertices.col(now.to) - mesh_.vertices.col(now.from)).norm();
            curve.is_closed = now.to == curve.vertices.front();
            if (curve.is_closed) break;
            curve.vertices.push_back(now.to);
            if (is_end(now.to)) break;
            edge = first_from_.at(now.to);
        }
        curves_.push_back(std::move(curve));
    }

    const TriMesh& mesh_;
    const std::map<int, int>& degree_;
    std::vector<BorderEdge> edges_;  ///< sorted
    std::vector<char> is_taken_;
    std::map<int, std::size_t> first_from_;  ///< the edge that leaves a vertex
    std::vector<BorderCurve> curves_;
};

}  // namespace

std::vector<BorderCurve> part_borders(const TriMesh& mesh, const std::vector<int>& part_of_face) {
    const std::vector<BorderEdge> edges = border_edges(mesh, part_of_face);
    std::map<int, int> degree;
    for (const BorderEdge& edge : edges) {
        ++degree[edge.from];
        ++degree[edge.to];
    }
    std::vector<BorderCurve> curves;
    for (auto begin = edges.begin(); begin != edges.end();) {
        const auto end = std::find_if(begin, edges.end(),
                                      [&](const BorderEdge& edge) { return !edge.is_of_same_parts(*begin); });
        std::vector<BorderCurve> found = CurveTracer(mesh, degree, {begin, end}).run();
        std::sort(found.begin(), found.end(),
                  [](const BorderCurve& x, const BorderCurve& y) { return x.vertices < y.vertices; });
        curves.insert(curves.end(), std::make_move_iterator(found.begin()),
                      std::make_move_iterator(found.end()));
        begin = end;
    }
    return curves;
}

}  // namespace coseg
