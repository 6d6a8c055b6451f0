#include "src/repair/border_matching.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>

#include "src/base/index.hpp"
#include "src/mesh/edge_groups.hpp"
#include "src/mesh/polygon_edges.hpp"

namespace coseg {

namespace {

using Eigen::Vector3d;

constexpr std::size_t most_in_reach = 16;

/// Faces whose inward directions at an edge have a greater cosine, an angle of less than 10 degrees, lie upon
/// each other.
constexpr double upon_each_other = 0.985;

Vector3d inward_of(const PolygonMesh& mesh, int face, const Vector3d& from, const Vector3d& to) {
    Vector3d mean = Vector3d::Zero();
    const int begin = mesh.offsets[at(face)];
    const int end = mesh.offsets[at(face) + 1];
    for (int k = begin; k < end; ++k) mean += (mesh.vertices[at(mesh.corners[at(k)])] - from) / (end - begin);
    const Vector3d along = (to - from).normalized();
    return (mean - mean.dot(along) * along).normalized();
}

class BorderMatcher {
  public:
    BorderMatcher(const PolygonMesh& mesh, const std::vector<BorderEdge>& edges, const BorderLimits& limits)
        : mesh_(mesh), edges_(edges), limits_(limits), size_limit_(limits.of_size * used_diagonal(mesh)) {
        double longest = 0.0;
        for (int e = 0; e < edge_count(); ++e) {
            const auto& [a, b, face, inward] = edges[at(e)];
            const double length = (mesh.vertices[at(a)] - mesh.vertices[at(b)]).norm();
            longest = std::max(longest, length);
            for (const int v : {a, b}) {
                const auto [entry, is_new] = shortest_.try_emplace(v, length);
                if (!is_new) entry->second = std::min(entry->second, length);
                edges_at_[v].push_back(e);
            }
        }
        cell_size_ = std::min(size_limit_, limits.of_edge * longest);
        for (const auto& [v, length] : shortest_) cells_[cell_of(v)].push_back(v);
    }

    [[nodiscard]] std::vector<BorderMatch> matches() const {
        std::vector<BorderMatch> found;
        if (!(cell_size_ > 0.0)) return found;
        for (int e = 0; e < edge_count(); ++e) {
            const std::vector<BorderMatch> candidates = matches_of(e);
            if (candidates.size() == 1) found.push_back(candidates.front());
        }
        return found;
    }

  private:
    using Cell = std::array<std::int64_t, 3>;

    [[nodiscard]] int edge_count() const { return static_cast<int>(edges_.size()); }

    [[nodiscard]] Cell cell_of(int v) const {
        Cell cell{};
        for (int k = 0; k < 3; ++k) {
            const double place = mesh_.vertices[at(v)][k] / cell_size_;
            cell[at(k)] = std::abs(place) < 1e15 ? static_cast<std::int64_t>(std::floor(place)) : 0;
        }
        return cell;
    }

    [[nodiscard]] double distance(int a, int b) const {
        return (mesh_.vertices[at(a)] - mesh_.vertices[at(b)]).norm();
    }

    [[nodiscard]] bool is_near(int a, int b) const {
        const double limit =
            std::min(size_limit_, limits_.of_edge * std::min(shortest_.at(a), shortest_.at(b)));
        return a == b || distance(a, b) <= limit;
    }

    /// Border vertices near to one, itself among them; none where there are too many.
    [[nodiscard]] std::vector<int> near(int v) const {
        std::vector<int> found;
        const Cell centre = cell_of(v);
        for (int n = 0; n < 27; ++n) {
            const auto cell =
                cells_.find({centre[0] + n % 3 - 1, centre[1] + n / 3 % 3 - 1, centre[2] + n / 9 - 1});
            if (cell == cells_.end()) continue;
            if (cell->second.size() > most_in_reach) return {};
            for (const int other : cell->second) {
                if (is_near(v, other)) found.push_back(other);
            }
        }
        return found;
    }

    [[nodiscard]] bool goes_on(const BorderEdge& one, const BorderEdge& other) const {
        const bool shares_vertex =
            one.from == other.from || one.from == other.to || one.to == other.from || one.to == other.to;
        return !shares_vertex && one.inward.dot(other.inward) <= upon_each_other;
    }

    [[nodiscard]] std::vector<BorderMatch> matches_of(int e) const {
        std::vector<BorderMatch> matches;
        const BorderEdge& edge = edges_[at(e)];
        for (const int at_from : near(edge.from)) {
            const std::vector<int>& around = edges_at_.at(at_from);
            if (around.size() > 2 * most_in_reach) continue;
            for (const int o : around) {
                const BorderEdge& other = edges_[at(o)];
                const bool runs_back = other.to == at_from;
                if (o == e || (limits_.must_continue ? !goes_on(edge, other) : !runs_back)) continue;
                const int at_to = runs_back ? other.from : other.to;
                if (!is_near(edge.to, at_to)) continue;
                matches.push_back(
                    {e, o, at_from, at_to, std::max(distance(edge.from, at_from), distance(edge.to, at_to))});
            }
        }
        return matches;
    }

    const PolygonMesh& mesh_;
    const std::vector<BorderEdge>& edges_;
    BorderLimits limits_;
    double size_limit_;
    double cell_size_ = 0.0;
    std::map<int, double> shortest_;            // per border vertex its shortest border edge
    std::map<Cell, std::vector<int>> cells_;    // border vertices
    std::map<int, std::vector<int>> edges_at_;  // per border vertex the edges that end there
};

}  // namespace

std::vector<BorderEdge> border_edges(const PolygonMesh& mesh, const std::vector<int>& vertex_of) {
    const PolygonHalfEdges all = polygon_half_edges(mesh, vertex_of);
    const EdgeGroups groups = group_edges(all.from, all.to, mesh.vertex_count());
    std::vector<BorderEdge> edges;
    for (int g = 0; g < groups.count(); ++g) {
        const int begin = groups.offsets[at(g)];
        if (groups.offsets[at(g) + 1] - begin != 1) continue;
        const auto h = at(groups.half_edges[at(begin)]);
        edges.push_back(
            {all.from[h], all.to[h], all.face[h],
             inward_of(mesh, all.face[h], mesh.vertices[at(all.from[h])], mesh.vertices[at(all.to[h])])});
    }
    return edges;
}

double used_diagonal(const PolygonMesh& mesh) {
    if (mesh.corners.empty()) return 0.0;
    Vector3d low = mesh.vertices[at(mesh.corners.front())];
    Vector3d high = low;
    for (const int v : mesh.corners) {
        low = low.cwiseMin(mesh.vertices[at(v)]);
        high = high.cwiseMax(mesh.vertices[at(v)]);
    }
    return (high - low).norm();
}

std::vector<BorderMatch> match_borders(const PolygonMesh& mesh, const std::vector<BorderEdge>& edges,
                                       const BorderLimits& limits) {
    return BorderMatcher(mesh, edges, limits).matches();
}

}  // namespace coseg
