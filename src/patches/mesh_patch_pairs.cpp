#include "src/patches/mesh_patch_pairs.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

#include "src/base/index.hpp"

namespace coseg {

namespace {

int patch_count(const std::vector<int>& patch_of_face) {
    return patch_of_face.empty() ? 0 : *std::max_element(patch_of_face.begin(), patch_of_face.end()) + 1;
}

}  // namespace

Eigen::VectorXd patch_areas(const FaceGeometry& geometry, const std::vector<int>& patch_of_face, int count) {
    Eigen::VectorXd area = Eigen::VectorXd::Zero(count);
    for (std::size_t f = 0; f < patch_of_face.size(); ++f) {
        area[patch_of_face[f]] += geometry.area[static_cast<Eigen::Index>(f)];
    }
    return area;
}

std::vector<PatchNeighbors> patch_neighbors(const DualGraph& graph, const std::vector<int>& patch_of_face,
                                            const Eigen::VectorXd& vertex_minimum_curvature) {
    std::vector<PatchNeighbors> contacts;  // one an edge first, `concavity` times length, then added up
    for (const DualEdge& e : graph.edges) {
        const int a = patch_of_face[at(e.face_a)];
        const int b = patch_of_face[at(e.face_b)];
        if (a == b) continue;
        const double mean_curvature =
            e.is_virtual()
                ? 0.0
                : 0.5 * (vertex_minimum_curvature[e.vertex_a] + vertex_minimum_curvature[e.vertex_b]);
        contacts.push_back({std::min(a, b), std::max(a, b), e.length, e.length * mean_curvature});
    }
    std::stable_sort(contacts.begin(), contacts.end(), [](const PatchNeighbors& x, const PatchNeighbors& y) {
        return std::tie(x.patch_a, x.patch_b) < std::tie(y.patch_a, y.patch_b);
    });
    std::vector<PatchNeighbors> pairs;
    for (const PatchNeighbors& c : contacts) {
        if (pairs.empty() || pairs.back().patch_a != c.patch_a || pairs.back().patch_b != c.patch_b) {
            pairs.push_back(c);
        } else {
            pairs.back().boundary_length += c.boundary_length;
            pairs.back().concavity += c.concavity;
        }
    }
    for (PatchNeighbors& pair : pairs) {
        pair.concavity =
            pair.boundary_length > 0.0 ? std::clamp(pair.concavity / pair.boundary_length, 0.0, 1.0) : 0.0;
    }
    return pairs;
}

std::vector<PatchOverlap> patch_overlaps(const FaceGeometry& geometry, const std::vector<int>& patches_a,
                                         const std::vector<int>& patches_b) {
    const Eigen::VectorXd area_a = patch_areas(geometry, patches_a, patch_count(patches_a));
    const Eigen::VectorXd area_b = patch_areas(geometry, patches_b, patch_count(patches_b));
    const auto pair_of = [&](int f) { return std::pair(patches_a[at(f)], patches_b[at(f)]); };
    std::vector<int> faces(patches_a.size());
    std::iota(faces.begin(), faces.end(), 0);
    std::stable_sort(faces.begin(), faces.end(), [&](int f, int g) { return pair_of(f) < pair_of(g); });
    std::vector<PatchOverlap> overlaps;
    for (std::size_t begin = 0, end = 0; begin < faces.size(); begin = end) {
        const auto [a, b] = pair_of(faces[begin]);
        double common = 0.0;
        for (; end < faces.size() && pair_of(faces[end]) == std::pair(a, b); ++end)
            common += geometry.area[faces[end]];
        if (!(common > 0.0)) continue;
        overlaps.push_back({a, b, std::min(1.0, common / (area_a[a] + area_b[b] - common))});
    }
    return overlaps;
}

}  // namespace coseg
