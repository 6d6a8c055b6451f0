#include "src/mesh/connected_pieces.hpp"

#include <cstddef>

#include "src/base/index.hpp"

namespace coseg {

std::vector<int> connected_pieces(const DualGraph& graph, const std::vector<int>& label_of_face,
                                  VirtualEdges virtual_edges) {
    std::vector<int> piece(at(graph.face_count), -1);
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
                if (virtual_edges == VirtualEdges::ignored && graph.edges[at(e)].is_virtual()) continue;
                const int g = graph.other_face(e, f);
                if (piece[at(g)] >= 0 || label_of_face[at(f)] != label_of_face[at(g)]) continue;
                piece[at(g)] = count;
                stack.push_back(g);
            }
        }
        ++count;
    }
    return piece;
}

}  // namespace coseg
