#include "src/mesh/connected_pieces.hpp"

#include <cstddef>

namespace coseg {

namespace {

/// Flood fill over the dual edges for which `joined(edge, face, other face)` holds.
template <typename Joined>
std::vector<int> flooded_pieces(const DualGraph& graph, const Joined& joined) {
    std::vector<int> piece(static_cast<std::size_t>(graph.face_count), -1);
    std::vector<int> stack;
    int count = 0;
    for (int seed = 0; seed < graph.face_count; ++seed) {
        if (piece[static_cast<std::size_t>(seed)] >= 0) continue;
        piece[static_cast<std::size_t>(seed)] = count;
        stack.assign(1, seed);
        while (!stack.empty()) {
            const int f = stack.back();
            stack.pop_back();
            for (int k = graph.offsets[static_cast<std::size_t>(f)];
                 k < graph.offsets[static_cast<std::size_t>(f) + 1]; ++k) {
                const int e = graph.incident[static_cast<std::size_t>(k)];
                const int g = graph.other_face(e, f);
                if (piece[static_cast<std::size_t>(g)] >= 0 || !joined(e, f, g)) continue;
                piece[static_cast<std::size_t>(g)] = count;
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
        if (virtual_edges == VirtualEdges::ignored && graph.edges[static_cast<std::size_t>(e)].is_virtual)
            return false;
        return label_of_face[static_cast<std::size_t>(f)] == label_of_face[static_cast<std::size_t>(g)];
    });
}

std::vector<int> intersection_pieces(const DualGraph& graph,
                                     const std::vector<std::vector<int>>& labellings) {
    return flooded_pieces(graph, [&](int, int f, int g) {
        for (const auto& label : labellings) {
            if (label[static_cast<std::size_t>(f)] != label[static_cast<std::size_t>(g)]) return false;
        }
        return true;
    });
}

}  // namespace coseg
