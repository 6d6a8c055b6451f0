#include "src/half_edges.hpp"

#include <algorithm>
#include <array>

namespace coseg {

std::vector<HalfEdge> sorted_half_edges(const TriMesh& mesh) {
    std::vector<HalfEdge> half_edges;
    half_edges.reserve(static_cast<std::size_t>(mesh.face_count()) * 3);
    for (int f = 0; f < mesh.face_count(); ++f) {
        for (int k = 0; k < 3; ++k) {
            const int a = mesh.faces(k, f);
            const int b = mesh.faces((k + 1) % 3, f);
            half_edges.push_back({std::min(a, b), std::max(a, b), f, a < b});
        }
    }
    std::sort(half_edges.begin(), half_edges.end(), [](const HalfEdge& x, const HalfEdge& y) {
        return std::array{x.low, x.high, x.face} < std::array{y.low, y.high, y.face};
    });
    return half_edges;
}

}  // namespace coseg
