#include "src/repair/outlying_vertices.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "src/base/index.hpp"

namespace coseg {

namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

constexpr double most_sizes_away = 30.0;
constexpr double shortest_edge_share = 0.3;  // of the distance
constexpr std::size_t fewest_per_outlier = 100;

std::vector<int> vertices_in_use(const std::vector<Vector3i>& triangles, std::size_t vertices) {
    std::vector<char> used(vertices, 0);
    for (const Vector3i& t : triangles) used[at(t[0])] = used[at(t[1])] = used[at(t[2])] = 1;
    std::vector<int> list;
    for (std::size_t v = 0; v < vertices; ++v) {
        if (used[v] != 0) list.push_back(static_cast<int>(v));
    }
    return list;
}

double share_of(std::vector<double> values, double share) {
    const auto place = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + place, values.end());
    return values[static_cast<std::size_t>(place)];
}

Vector3d median_point(const std::vector<int>& vertices, const std::vector<Vector3d>& positions) {
    Vector3d median;
    std::vector<double> values(vertices.size());
    for (int k = 0; k < 3; ++k) {
        for (std::size_t i = 0; i < vertices.size(); ++i) values[i] = positions[at(vertices[i])][k];
        median[k] = share_of(values, 0.5);
    }
    return median;
}

/// Per vertex the length of its shortest edge, infinite where it has none.
std::vector<double> shortest_edges(const std::vector<Vector3i>& triangles,
                                   const std::vector<Vector3d>& positions) {
    std::vector<double> shortest(positions.size(), std::numeric_limits<double>::infinity());
    for (const Vector3i& t : triangles) {
        for (int k = 0; k < 3; ++k) {
            const int a = t[k];
            const int b = t[(k + 1) % 3];
            if (a == b) continue;
            const double length = (positions[at(a)] - positions[at(b)]).norm();
            shortest[at(a)] = std::min(shortest[at(a)], length);
            shortest[at(b)] = std::min(shortest[at(b)], length);
        }
    }
    return shortest;
}

/// Per vertex whether it is outlying; empty if none is far away.
std::vector<char> mark_outlying(const std::vector<Vector3i>& triangles, const std::vector<int>& vertices,
                                const std::vector<Vector3d>& positions) {
    const Vector3d median = median_point(vertices, positions);
    std::vector<double> distance;
    for (const int v : vertices) distance.push_back((positions[at(v)] - median).norm());
    const double limit = most_sizes_away * share_of(distance, 0.9);
    if (!(*std::max_element(distance.begin(), distance.end()) > limit)) return {};
    const std::vector<double> shortest = shortest_edges(triangles, positions);
    std::vector<char> outlying(positions.size(), 0);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const auto v = at(vertices[i]);
        if (distance[i] > limit && shortest[v] > shortest_edge_share * distance[i]) outlying[v] = 1;
    }
    return outlying;
}

}  // namespace

int remove_outlying(WorkingTriangles& working, const std::vector<Vector3d>& positions) {
    const std::vector<int> vertices = vertices_in_use(working.triangles, positions.size());
    if (vertices.size() < fewest_per_outlier) return 0;
    const std::vector<char> outlying = mark_outlying(working.triangles, vertices, positions);
    const auto count = static_cast<std::size_t>(std::count(outlying.begin(), outlying.end(), 1));
    if (count == 0 || fewest_per_outlier * count > vertices.size()) return 0;
    const auto is_kept = [&](const Vector3i& t) {
        return outlying[at(t[0])] == 0 && outlying[at(t[1])] == 0 && outlying[at(t[2])] == 0;
    };
    const auto kept_count =
        static_cast<std::size_t>(std::count_if(working.triangles.begin(), working.triangles.end(), is_kept));
    if (fewest_per_outlier * (working.triangles.size() - kept_count) > working.triangles.size()) return 0;
    WorkingTriangles kept;
    for (std::size_t i = 0; i < working.triangles.size(); ++i) {
        if (!is_kept(working.triangles[i])) continue;
        kept.triangles.push_back(working.triangles[i]);
        kept.input_face.push_back(working.input_face[i]);
    }
    working = std::move(kept);
    return static_cast<int>(count);
}

}  // namespace coseg
