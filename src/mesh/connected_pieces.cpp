#include "src/mesh/connected_pieces.hpp"

#include <cstddef>

#include "src/base/index.hpp"

namespace coseg {

namespace {

/// Flood fill over the dual edges for which `joined(edge, face, other face)` holds.
template <typename Joined>
std::vector<int> flooded_pieces(const DualGraph& graph, const Joined& joined) {
    std::vector<int> piece(static_cast<std::size_t>(graph.face_count), -1);
    std::vector<int> stack;
    int count = 0;
    for (int seed = 0; seed < graph.face_count; ++seed) {
        if (piece[at(seed)] >= 0) continue;
        piece[at(seed)] = count;
        stack.assign(1, seed);
        while (!stack.empty()) {
            const int f = stack.back();
            stack.pop_back();
            for (int k = graph.offsets[at(f)]; k < graph.offsets[at(f) + 1]; ++k) {
                const int e = graph.incident[at(k)];
                const int g = graph.other_face(e, f);
                if (piece[at(g)] >= 0 || !joined(e, f, g)) continue;
                piece[at(g)] = count;
                stack.push_back(g);
            }
        }
        ++count;
    }
    return piece;
}

}  // namespace

std::vector<int> connected_pieces(const DualGraph& graph, const std::vector<int>& label_of_face,
                                  VirtualEdges virtual_edges) {
    return flooded_pieces(graph, [&](int e, int f, int g) {
        if (virtual_edges == VirtualEdges::ignored && graph.edges[at(e)].is_virtual) return false;
        return label_of_face[at(f)] == label_of_face[at(g)];
    });
}

std::vector<int> intersection_pieces(const DualGraph& graph,
                                     const std::vector<std::vector<int>>& labellings) {
    return flooded_pieces(graph, [&](int, int f, int g) {
        for (const auto& label : labellings) {
            if (label[at(f)] != label[at(g)]) return false;
        }
        return true;
    });
}

}  // namespace coseg
