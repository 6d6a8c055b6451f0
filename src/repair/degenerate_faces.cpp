#include "src/repair/degenerate_faces.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "src/base/index.hpp"
#include "src/mesh/edge_groups.hpp"

namespace coseg {

namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

/// A neighbour across a split may be degenerate itself and pass the split on; the rest is dropped with a gap.
constexpr int max_rounds = 16;

bool repeats_vertex(const Vector3i& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

/// The k whose edge (corner k to corner k + 1) is longest.
int longest_edge(const Vector3i& t, const std::vector<Vector3d>& p) {
    int best = 0;
    double best_length = -1.0;
    for (int k = 0; k < 3; ++k) {
        const double length = (p[at(t[(k + 1) % 3])] - p[at(t[k])]).squaredNorm();
        if (length > best_length) {
            best_length = length;
            best = k;
        }
    }
    return best;
}

int erase_marked(WorkingTriangles& working, const std::vector<char>& marked) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < working.triangles.size(); ++i) {
        if (marked[i] != 0) continue;
        working.triangles[kept] = working.triangles[i];
        working.input_face[kept] = working.input_face[i];
        ++kept;
    }
    const auto removed = static_cast<int>(working.triangles.size() - kept);
    working.triangles.resize(kept);
    working.input_face.resize(kept);
    return removed;
}

EdgeGroups edges_of(const std::vector<Vector3i>& triangles, std::size_t vertices) {
    std::vector<int> from;
    std::vector<int> to;
    from.reserve(3 * triangles.size());
    to.reserve(3 * triangles.size());
    for (const Vector3i& t : triangles) {
        for (int k = 0; k < 3; ++k) {
            from.push_back(t[k]);
            to.push_back(t[(k + 1) % 3]);
        }
    }
    return group_edges(from, to, static_cast<int>(vertices));
}

/// Splits triangle `n` at vertex `middle`, which lies on its edge of half-edge `h`; the second half is
/// appended.
void split_at(WorkingTriangles& working, int n, int h, int middle) {
    const Vector3i t = working.triangles[at(n)];
    const int k = h % 3;
    const int a = t[k];
    const int b = t[(k + 1) % 3];
    const int c = t[(k + 2) % 3];
    working.triangles[at(n)] = {a, middle, c};
    working.triangles.emplace_back(middle, b, c);
    working.input_face.push_back(working.input_face[at(n)]);
}

/// One round: every degenerate triangle whose longest edge has exactly one other triangle, untouched in this
/// round, hands its middle vertex to that triangle. Returns the triangles so removed, marked.
std::vector<char> split_neighbours(WorkingTriangles& working, const std::vector<char>& degenerate,
                                   const std::vector<Vector3d>& positions) {
    const std::size_t count = working.triangles.size();
    std::vector<char> touched(count, 0);
    std::vector<char> removed(count, 0);
    const EdgeGroups groups = edges_of(working.triangles, positions.size());
    for (int g = 0; g < groups.count(); ++g) {
        const int begin = groups.offsets[at(g)];
        if (groups.offsets[at(g) + 1] - begin != 2) continue;
        for (int turn = 0; turn < 2; ++turn) {
            const int h = groups.half_edges[at(begin + turn)];
            const int other = groups.half_edges[at(begin + 1 - turn)];
            const int f = h / 3;
            const int n = other / 3;
            if (degenerate[at(f)] == 0 || touched[at(f)] != 0 || touched[at(n)] != 0 || f == n) continue;
            if (longest_edge(working.triangles[at(f)], positions) != h % 3) continue;
            const int middle = working.triangles[at(f)][(h % 3 + 2) % 3];
            if ((working.triangles[at(n)].array() == middle).any()) continue;
            split_at(working, n, other, middle);
            touched[at(f)] = touched[at(n)] = removed[at(f)] = 1;
        }
    }
    removed.resize(working.triangles.size(), 0);
    return removed;
}

std::vector<char> mark_degenerate(const WorkingTriangles& working, const std::vector<Vector3d>& positions) {
    std::vector<char> marked(working.triangles.size());
    for (std::size_t i = 0; i < marked.size(); ++i)
        marked[i] = is_degenerate(working.triangles[i], positions) ? 1 : 0;
    return marked;
}

}  // namespace

bool is_degenerate(const Vector3i& t, const std::vector<Vector3d>& p) {
    if (repeats_vertex(t)) return true;
    const Vector3d ab = p[at(t[1])] - p[at(t[0])];
    const Vector3d ac = p[at(t[2])] - p[at(t[0])];
    const double longest = std::max({ab.squaredNorm(), ac.squaredNorm(), (ac - ab).squaredNorm()});
    return !(ab.cross(ac).norm() > degenerate_height * longest);
}

int remove_degenerate(WorkingTriangles& working, const std::vector<Vector3d>& positions) {
    const std::vector<char> degenerate = mark_degenerate(working, positions);
    const auto count = static_cast<int>(std::count(degenerate.begin(), degenerate.end(), 1));
    if (count == 0) return 0;
    std::vector<char> repeated(working.triangles.size());
    for (std::size_t i = 0; i < repeated.size(); ++i)
        repeated[i] = repeats_vertex(working.triangles[i]) ? 1 : 0;
    erase_marked(working, repeated);
    for (int round = 0; round < max_rounds; ++round) {
        const std::vector<char> marked = mark_degenerate(working, positions);
        if (std::count(marked.begin(), marked.end(), 1) == 0) break;
        if (erase_marked(working, split_neighbours(working, marked, positions)) == 0) break;
    }
    erase_marked(working, mark_degenerate(working, positions));
    return count;
}

}  // namespace coseg
