#include "src/measures/part_pieces.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "src/base/index.hpp"
#include "src/mesh/half_edges.hpp"

namespace coseg {

namespace {

/// The lowest face that is known to be joined with `face`.
int lowest_of(std::vector<int>& joined, int face) {
    while (joined[at(face)] != face) {
        joined[at(face)] = joined[at(joined[at(face)])];
        face = joined[at(face)];
    }
    return face;
}

}  // namespace

std::vector<int> part_pieces(const TriMesh& mesh, const std::vector<int>& part_of_face) {
    std::vector<int> joined(at(mesh.face_count()));
    std::iota(joined.begin(), joined.end(), 0);
    const std::vector<HalfEdge> sides = sorted_half_edges(mesh);
    for (std::size_t k = 1; k < sides.size(); ++k) {
        if (!share_edge(sides[k - 1], sides[k])) continue;
        if (part_of_face[at(sides[k - 1].face)] != part_of_face[at(sides[k].face)]) continue;
        const auto [low, high] =
            std::minmax({lowest_of(joined, sides[k - 1].face), lowest_of(joined, sides[k].face)});
        joined[at(high)] = low;
    }
    std::vector<int> piece(joined.size(), -1);
    int pieces = 0;
    for (int f = 0; f < mesh.face_count(); ++f) {
        const int lowest = lowest_of(joined, f);
        piece[at(f)] = lowest == f ? pieces++ : piece[at(lowest)];
    }
    return piece;
}

}  // namespace coseg
