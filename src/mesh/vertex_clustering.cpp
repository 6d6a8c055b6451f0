#include "src/mesh/vertex_clustering.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <set>

#include "src/base/index.hpp"

namespace coseg {

namespace {

ClusteredMesh on_grid(const TriMesh& mesh, int cells) {
    const Eigen::Vector3d low = mesh.vertices.rowwise().minCoeff();
    const double extent = (mesh.vertices.rowwise().maxCoeff() - low).maxCoeff();
    const double scale = extent > 0.0 ? cells / extent : 0.0;
    std::map<std::array<std::int64_t, 3>, int> cluster_at;
    std::vector<int> cluster_of;
    std::vector<Eigen::Vector3d> sums;
    std::vector<int> counts;
    for (const auto& point : mesh.vertices.colwise()) {
        std::array<std::int64_t, 3> cell{};
        for (int k = 0; k < 3; ++k)
            cell[at(k)] = static_cast<std::int64_t>(std::floor((point[k] - low[k]) * scale));
        const auto [place, is_new] = cluster_at.try_emplace(cell, static_cast<int>(sums.size()));
        if (is_new) {
            sums.emplace_back(Eigen::Vector3d::Zero());
            counts.push_back(0);
        }
        cluster_of.push_back(place->second);
        sums[at(place->second)] += point;
        ++counts[at(place->second)];
    }
    ClusteredMesh coarse;
    coarse.mesh.vertices.resize(3, static_cast<Eigen::Index>(sums.size()));
    for (std::size_t c = 0; c < sums.size(); ++c)
        coarse.mesh.vertices.col(static_cast<Eigen::Index>(c)) = sums[c] / counts[c];
    std::vector<Eigen::Vector3i> faces;
    std::set<std::array<int, 3>> seen;
    for (int f = 0; f < mesh.face_count(); ++f) {
        std::array<int, 3> corners{};
        for (int k = 0; k < 3; ++k) corners[at(k)] = cluster_of[at(mesh.faces(k, f))];
        const auto [a, b, c] = corners;
        if (a == b || b == c || c == a) continue;
        std::sort(corners.begin(), corners.end());
        if (!seen.insert(corners).second) continue;
        faces.emplace_back(a, b, c);
        coarse.triangle.push_back(f);
    }
    coarse.mesh.faces.resize(3, static_cast<Eigen::Index>(faces.size()));
    for (std::size_t f = 0; f < faces.size(); ++f)
        coarse.mesh.faces.col(static_cast<Eigen::Index>(f)) = faces[f];
    return coarse;
}

}  // namespace

ClusteredMesh clustered(const TriMesh& mesh, int most_faces) {
    if (mesh.face_count() <= most_faces) {
        ClusteredMesh same{mesh, std::vector<int>(at(mesh.face_count()))};
        std::iota(same.triangle.begin(), same.triangle.end(), 0);
        return same;
    }
    int fits = 1;
    int too_fine = 1024;
    while (too_fine - fits > 1) {
        const int middle = (fits + too_fine) / 2;
        (on_grid(mesh, middle).mesh.face_count() <= most_faces ? fits : too_fine) = middle;
    }
    return on_grid(mesh, fits);
}

}  // namespace coseg
