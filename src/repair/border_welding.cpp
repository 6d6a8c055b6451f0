#include "src/repair/border_welding.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>

#include "src/base/index.hpp"
#include "src/mesh/edge_groups.hpp"

namespace coseg {

namespace {

using Eigen::Vector3d;

constexpr double share_of_diagonal = 1e-5;
constexpr double share_of_edge = 1e-3;
constexpr std::size_t most_in_reach = 16;

using BorderEdge = std::pair<int, int>;

/// The edges that one face alone has, in its direction, over stand-ins.
std::vector<BorderEdge> border_edges(const PolygonMesh& mesh, const std::vector<int>& vertex_of) {
    std::vector<int> from;
    std::vector<int> to;
    for (int f = 0; f < mesh.face_count(); ++f) {
        const int begin = mesh.offsets[at(f)];
        const int end = mesh.offsets[at(f) + 1];
        for (int k = begin; k < end; ++k) {
            from.push_back(vertex_of[at(mesh.corners[at(k)])]);
            to.push_back(vertex_of[at(mesh.corners[at(k + 1 < end ? k + 1 : begin)])]);
        }
    }
    const EdgeGroups groups = group_edges(from, to, mesh.vertex_count());
    std::vector<BorderEdge> edges;
    for (int g = 0; g < groups.count(); ++g) {
        const int begin = groups.offsets[at(g)];
        if (groups.offsets[at(g) + 1] - begin != 1) continue;
        const auto h = at(groups.half_edges[at(begin)]);
        edges.emplace_back(from[h], to[h]);
    }
    return edges;
}

double diagonal_of(const PolygonMesh& mesh, const std::vector<BorderEdge>& edges) {
    Vector3d low = mesh.vertices[at(edges.front().first)];
    Vector3d high = low;
    for (const int v : mesh.corners) {
        low = low.cwiseMin(mesh.vertices[at(v)]);
        high = high.cwiseMax(mesh.vertices[at(v)]);
    }
    return (high - low).norm();
}

class BorderWelder {
  public:
    BorderWelder(const PolygonMesh& mesh, std::vector<BorderEdge> edges)
        : mesh_(mesh), edges_(std::move(edges)), cell_size_(share_of_diagonal * diagonal_of(mesh, edges_)) {
        for (const auto& [a, b] : edges_) {
            const double length = (mesh.vertices[at(a)] - mesh.vertices[at(b)]).norm();
            for (const int v : {a, b}) {
                const auto [entry, is_new] = shortest_.try_emplace(v, length);
                if (is_new)
                    cells_[cell_of(v)].push_back(v);
                else
                    entry->second = std::min(entry->second, length);
            }
            starts_of_[b].push_back(a);
        }
    }

    /// Pairs of vertices to be joined.
    [[nodiscard]] std::vector<BorderEdge> pairs() const {
        std::vector<BorderEdge> pairs;
        if (!(cell_size_ > 0.0)) return pairs;
        for (const auto& [a, b] : edges_) {
            const std::vector<BorderEdge> matches = matches_of(a, b);
            if (matches.size() != 1) continue;
            const auto [c, d] = matches.front();
            if (a != d) pairs.emplace_back(a, d);
            if (b != c) pairs.emplace_back(b, c);
        }
        return pairs;
    }

  private:
    using Cell = std::array<std::int64_t, 3>;

    [[nodiscard]] Cell cell_of(int v) const {
        Cell cell{};
        for (int k = 0; k < 3; ++k) {
            const double place = mesh_.vertices[at(v)][k] / cell_size_;
            cell[at(k)] = std::abs(place) < 1e15 ? static_cast<std::int64_t>(std::floor(place)) : 0;
        }
        return cell;
    }

    [[nodiscard]] bool is_near(int a, int b) const {
        const double limit = std::min(cell_size_, share_of_edge * std::min(shortest_.at(a), shortest_.at(b)));
        return a == b || (mesh_.vertices[at(a)] - mesh_.vertices[at(b)]).norm() <= limit;
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

    /// Border edges (c, d) with d near a and c near b.
    [[nodiscard]] std::vector<BorderEdge> matches_of(int a, int b) const {
        std::vector<BorderEdge> matches;
        for (const int d : near(a)) {
            const auto starts = starts_of_.find(d);
            if (starts == starts_of_.end() || starts->second.size() > most_in_reach) continue;
            for (const int c : starts->second) {
                if (is_near(b, c)) matches.emplace_back(c, d);
            }
        }
        return matches;
    }

    const PolygonMesh& mesh_;
    std::vector<BorderEdge> edges_;
    double cell_size_;
    std::map<int, double> shortest_;             // per border vertex its shortest border edge
    std::map<Cell, std::vector<int>> cells_;     // border vertices
    std::map<int, std::vector<int>> starts_of_;  // per border vertex the starts of edges that end there
};

}  // namespace

BorderWelding weld_near_borders(const PolygonMesh& mesh, std::vector<int> vertex_of) {
    BorderWelding result{.vertex_of = std::move(vertex_of)};
    std::vector<BorderEdge> edges = border_edges(mesh, result.vertex_of);
    if (edges.empty()) return result;
    const std::vector<int> before = result.vertex_of;
    const auto root = [&](int v) {
        while (result.vertex_of[at(v)] != v) v = result.vertex_of[at(v)];
        return v;
    };
    for (const auto& [a, b] : BorderWelder(mesh, std::move(edges)).pairs()) {
        const int x = root(a);
        const int y = root(b);
        result.vertex_of[at(std::max(x, y))] = std::min(x, y);
    }
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        result.vertex_of[at(v)] = root(v);
        if (result.vertex_of[at(v)] != before[at(v)]) ++result.welded;
    }
    return result;
}

}  // namespace coseg
