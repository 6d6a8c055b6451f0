#include "src/repair/manifold_cut.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <tuple>
#include <utility>

#include "src/base/disjoint_sets.hpp"
#include "src/base/index.hpp"
#include "src/mesh/edge_groups.hpp"

namespace coseg {

namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

/// A closed component is flat, and its volume says nothing, below this share of area^(3/2).
constexpr double flat_volume = 1e-12;
/// The same of an open one, whose volume depends on how it is closed: a ball has .094, and half of a ball
/// without its base .133.
constexpr double flat_open_volume = 0.005;

/// Half-edge h = 3 f + k runs from corner k to corner k + 1 of triangle f; corner 3 f + k is its start.
class ManifoldCutter {
  public:
    ManifoldCutter(const std::vector<Vector3i>& triangles, const std::vector<Vector3d>& positions)
        : triangles_(triangles), positions_(positions), half_edges_(3 * static_cast<int>(triangles.size())) {
        mate_.assign(at(half_edges_), -1);
        flipped_.assign(triangles.size(), 0);
    }

    ManifoldCut run() {
        const EdgeGroups groups = given_edges();
        join_simple_edges(groups);
        orient_by_flood();
        cut_unorientable_edges();
        join_crowded_edges(groups);
        choose_sides();
        number_vertices();
        if (has_twins_ || result_.crowded_edges > 0 || result_.unorientable_edges > 0) {
            while (detach_offenders()) number_vertices();
        }
        finish();
        return std::move(result_);
    }

  private:
    [[nodiscard]] int start(int h) const { return triangles_[at(h / 3)][h % 3]; }
    [[nodiscard]] int next(int h) const { return h % 3 == 2 ? h - 2 : h + 1; }
    [[nodiscard]] int end(int h) const { return start(next(h)); }
    [[nodiscard]] int opposite(int h) const { return start(next(next(h))); }

    /// From lower to higher vertex number, once flips are taken into account.
    [[nodiscard]] bool runs_up(int h) const { return (start(h) < end(h)) != (flipped_[at(h / 3)] != 0); }

    void join(int a, int b) {
        mate_[at(a)] = b;
        mate_[at(b)] = a;
    }

    void cut(int h) {
        if (mate_[at(h)] >= 0) mate_[at(mate_[at(h)])] = -1;
        mate_[at(h)] = -1;
    }

    [[nodiscard]] EdgeGroups given_edges() const {
        std::vector<int> from(at(half_edges_));
        std::vector<int> to(at(half_edges_));
        for (int h = 0; h < half_edges_; ++h) {
            from[at(h)] = start(h);
            to[at(h)] = end(h);
        }
        return group_edges(from, to, static_cast<int>(positions_.size()));
    }

    void join_simple_edges(const EdgeGroups& groups) {
        for (int g = 0; g < groups.count(); ++g) {
            const int begin = groups.offsets[at(g)];
            if (groups.offsets[at(g) + 1] - begin != 2) continue;
            const int a = groups.half_edges[at(begin)];
            const int b = groups.half_edges[at(begin + 1)];
            if (opposite(a) != opposite(b))
                join(a, b);
            else
                has_twins_ = true;
        }
    }

    /// Visits each component from its lowest triangle; `enter(from half-edge, to triangle)` sees tree edges
    /// only.
    template <typename Enter, typename Done>
    void for_each_component(Enter enter, Done done) const {
        std::vector<char> seen(triangles_.size(), 0);
        std::vector<int> members;
        for (int seed = 0; seed < static_cast<int>(triangles_.size()); ++seed) {
            if (seen[at(seed)] != 0) continue;
            seen[at(seed)] = 1;
            members.assign(1, seed);
            for (std::size_t i = 0; i < members.size(); ++i) {
                for (int h = 3 * members[i]; h < 3 * members[i] + 3; ++h) {
                    const int other = mate_[at(h)] < 0 ? -1 : mate_[at(h)] / 3;
                    if (other < 0 || seen[at(other)] != 0) continue;
                    seen[at(other)] = 1;
                    enter(h, other);
                    members.push_back(other);
                }
            }
            done(members);
        }
    }

    void orient_by_flood() {
        for_each_component(
            [&](int h, int other) {
                if (runs_up(h) == runs_up(mate_[at(h)])) flipped_[at(other)] ^= 1;
            },
            [](const std::vector<int>&) {});
    }

    void cut_unorientable_edges() {
        for (int h = 0; h < half_edges_; ++h) {
            if (mate_[at(h)] < h || runs_up(h) != runs_up(mate_[at(h)])) continue;
            cut(h);
            ++result_.unorientable_edges;
        }
    }

    /// The half-edges of one edge by angle about it; at one angle those that run up come first, so that two
    /// coincident sheets stay two sheets instead of closing on each other.
    [[nodiscard]] std::vector<int> sorted_around(std::vector<int> ring) const {
        const int low = std::min(start(ring[0]), end(ring[0]));
        const int high = std::max(start(ring[0]), end(ring[0]));
        const Vector3d origin = positions_[at(low)];
        const Vector3d axis = (positions_[at(high)] - origin).normalized();
        const auto spoke = [&](int h) {
            const Vector3d d = positions_[at(opposite(h))] - origin;
            return Vector3d(d - d.dot(axis) * axis);
        };
        const Vector3d reference = spoke(ring[0]);
        std::vector<std::tuple<double, bool, int>> order;
        for (const int h : ring) {
            const Vector3d d = spoke(h);
            order.emplace_back(std::atan2(axis.dot(reference.cross(d)), reference.dot(d)), !runs_up(h), h);
        }
        std::sort(order.begin(), order.end());
        for (std::size_t i = 0; i < ring.size(); ++i) ring[i] = std::get<2>(order[i]);
        return ring;
    }

    /// A triangle that runs up has its solid at smaller angles, one that runs down at larger: "down, then up"
    /// is one solid wedge.
    void join_crowded_edges(const EdgeGroups& groups) {
        for (int g = 0; g < groups.count(); ++g) {
            const auto begin = groups.half_edges.begin() + groups.offsets[at(g)];
            const auto last = groups.half_edges.begin() + groups.offsets[at(g) + 1];
            if (last - begin < 3) continue;
            ++result_.crowded_edges;
            const std::vector<int> ring = sorted_around({begin, last});
            for (std::size_t i = 0; i < ring.size(); ++i) {
                const int down = ring[i];
                const int up = ring[(i + 1) % ring.size()];
                if (!runs_up(down) && runs_up(up) && opposite(down) != opposite(up)) join(down, up);
            }
        }
    }

    /// The centre of the borders of a component; none where it is closed.
    [[nodiscard]] std::optional<Vector3d> border_centre(const std::vector<int>& members) const {
        Vector3d sum = Vector3d::Zero();
        double length = 0.0;
        for (const int f : members) {
            for (int h = 3 * f; h < 3 * f + 3; ++h) {
                if (mate_[at(h)] >= 0) continue;
                const double edge = (positions_[at(end(h))] - positions_[at(start(h))]).norm();
                sum += 0.5 * edge * (positions_[at(end(h))] + positions_[at(start(h))]);
                length += edge;
            }
        }
        return length > 0.0 ? std::optional<Vector3d>(sum / length) : std::nullopt;
    }

    /// Borders are closed by cones to their centre, from which the volume is measured.
    [[nodiscard]] bool should_turn(const std::vector<int>& members) const {
        const std::optional<Vector3d> border = border_centre(members);
        const Vector3d origin = border.value_or(positions_[at(triangles_[at(members[0])][0])]);
        double volume = 0.0;
        double area = 0.0;
        double flipped_area = 0.0;
        for (const int f : members) {
            const Vector3d a = positions_[at(triangles_[at(f)][0])] - origin;
            const Vector3d b = positions_[at(triangles_[at(f)][1])] - origin;
            const Vector3d c = positions_[at(triangles_[at(f)][2])] - origin;
            const bool flip = flipped_[at(f)] != 0;
            const double face_area = 0.5 * (b - a).cross(c - a).norm();
            volume += (flip ? -1.0 : 1.0) * a.dot(b.cross(c)) / 6.0;
            area += face_area;
            if (flip) flipped_area += face_area;
        }
        const double flat = border ? flat_open_volume : flat_volume;
        if (std::abs(volume) > flat * area * std::sqrt(area)) return volume < 0.0;
        return flipped_area > 0.5 * area;
    }

    void choose_sides() {
        std::vector<int> to_turn;
        for_each_component([](int, int) {},
                           [&](const std::vector<int>& members) {
                               if (should_turn(members))
                                   to_turn.insert(to_turn.end(), members.begin(), members.end());
                           });
        for (const int f : to_turn) flipped_[at(f)] ^= 1;
    }

    /// Corners that meet across joined edges are one fan; each fan gets a vertex of its own.
    void number_vertices() {
        fans_ = DisjointSets(at(half_edges_));
        for (int h = 0; h < half_edges_; ++h) {
            const int m = mate_[at(h)];
            if (m < h) continue;
            const bool same_start = start(h) == start(m);
            fans_.join(h, same_start ? m : next(m));
            fans_.join(next(h), same_start ? next(m) : m);
        }
        std::vector<int> first_fan(positions_.size(), -1);
        std::vector<int> further_fans;
        for (int c = 0; c < half_edges_; ++c) {
            if (fans_.lowest(c) != c) continue;
            int& first = first_fan[at(start(c))];
            if (first < 0)
                first = c;
            else
                further_fans.push_back(c);
        }
        assign_numbers(first_fan, further_fans);
    }

    void assign_numbers(const std::vector<int>& first_fan, const std::vector<int>& further_fans) {
        std::vector<int> number(at(half_edges_), -1);
        result_.source_vertex.clear();
        const auto give_number = [&](int fan) {
            number[at(fan)] = static_cast<int>(result_.source_vertex.size());
            result_.source_vertex.push_back(start(fan));
        };
        for (const int fan : first_fan) {
            if (fan >= 0) give_number(fan);
        }
        for (const int fan : further_fans) give_number(fan);
        result_.copied_vertices = static_cast<int>(further_fans.size());
        result_.triangles.resize(triangles_.size());
        for (int c = 0; c < half_edges_; ++c)
            result_.triangles[at(c / 3)][c % 3] = number[at(fans_.lowest(c))];
    }

    /// After cuts both ends of an edge may still be shared by triangles that are not joined there. Those are
    /// cut loose altogether; they then have vertices of their own. Rare, and each round only cuts.
    bool detach_offenders() {
        std::vector<int> from(at(half_edges_));
        std::vector<int> to(at(half_edges_));
        for (int h = 0; h < half_edges_; ++h) {
            from[at(h)] = result_.triangles[at(h / 3)][h % 3];
            to[at(h)] = result_.triangles[at(next(h) / 3)][next(h) % 3];
        }
        const EdgeGroups groups = group_edges(from, to, static_cast<int>(result_.source_vertex.size()));
        bool found = false;
        for (int g = 0; g < groups.count(); ++g) {
            const auto begin = groups.half_edges.begin() + groups.offsets[at(g)];
            const auto last = groups.half_edges.begin() + groups.offsets[at(g) + 1];
            const bool good =
                last - begin == 1 || (last - begin == 2 && runs_up(*begin) != runs_up(*(begin + 1)));
            if (!good) detach_all_but_a_pair({begin, last});
            found = found || !good;
        }
        return found;
    }

    [[nodiscard]] bool fit_together(int a, int b) const {
        const auto across = [&](int h) {
            const int corner = next(next(h));
            return result_.triangles[at(corner / 3)][corner % 3];
        };
        return runs_up(a) != runs_up(b) && across(a) != across(b);
    }

    void detach_all_but_a_pair(const std::vector<int>& ring) {
        std::size_t keep_a = 0;
        std::size_t keep_b = 0;
        bool have_pair = false;
        for (std::size_t a = 0; a < ring.size() && !have_pair; ++a) {
            for (std::size_t b = a + 1; b < ring.size() && !have_pair; ++b) {
                if (mate_[at(ring[a])] != ring[b]) continue;
                have_pair = true;
                keep_a = a;
                keep_b = b;
            }
        }
        for (std::size_t i = 0; i < ring.size(); ++i) {
            if (i == keep_a || i == keep_b) continue;
            for (int k = 0; k < 3; ++k) cut(3 * (ring[i] / 3) + k);
        }
    }

    void finish() {
        for (std::size_t f = 0; f < triangles_.size(); ++f) {
            if (flipped_[f] == 0) continue;
            std::swap(result_.triangles[f][1], result_.triangles[f][2]);
            ++result_.flipped_triangles;
        }
    }

    const std::vector<Vector3i>& triangles_;
    const std::vector<Vector3d>& positions_;
    int half_edges_;
    std::vector<int> mate_;      ///< the joined half-edge, -1 at a boundary
    std::vector<char> flipped_;  ///< per triangle
    DisjointSets fans_{0};       ///< of corners
    bool has_twins_ = false;     ///< two triangles on the same three vertices were kept apart
    ManifoldCut result_;
};

}  // namespace

ManifoldCut cut_to_manifold(const std::vector<Vector3i>& triangles, const std::vector<Vector3d>& positions) {
    return ManifoldCutter(triangles, positions).run();
}

}  // namespace coseg
