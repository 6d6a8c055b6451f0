#include "src/families/label_cleaning.hpp"

#include <algorithm>
#include <map>

namespace coseg {

namespace {

/// Piece number of every face, numbered by lowest face; and the faces of each piece.
std::vector<std::vector<int>> label_pieces(const DualGraph& graph, const std::vector<int>& labels) {
    std::vector<char> seen(labels.size(), 0);
    std::vector<std::vector<int>> pieces;
    for (int seed = 0; seed < graph.face_count; ++seed) {
        if (seen[seed] != 0) continue;
        std::vector<int> piece{seed};
        seen[seed] = 1;
        for (std::size_t next = 0; next < piece.size(); ++next) {
            const int face = piece[next];
            for (int i = graph.offsets[face]; i < graph.offsets[face + 1]; ++i) {
                const int edge = graph.incident[i];
                const int other = graph.other_face(edge, face);
                if (graph.edges[edge].is_virtual() || seen[other] != 0 || labels[other] != labels[face])
                    continue;
                seen[other] = 1;
                piece.push_back(other);
            }
        }
        pieces.push_back(std::move(piece));
    }
    return pieces;
}

/// The label beyond the longest part of a piece's boundary, the lowest one of a tie; -1 without neighbours.
int surrounding_label(const DualGraph& graph, const std::vector<int>& labels, const std::vector<int>& piece) {
    std::map<int, double> boundary;
    const int own = labels[piece.front()];
    for (const int face : piece) {
        for (int i = graph.offsets[face]; i < graph.offsets[face + 1]; ++i) {
            const DualEdge& edge = graph.edges[graph.incident[i]];
            const int label = labels[graph.other_face(graph.incident[i], face)];
            if (!edge.is_virtual() && label != own) boundary[label] += edge.length;
        }
    }
    const auto longest = std::max_element(boundary.begin(), boundary.end(),
                                          [](const auto& a, const auto& b) { return a.second < b.second; });
    return longest == boundary.end() ? -1 : longest->first;
}

/// The label, other than its own, that at least two of a face's neighbours have; else its own.
int label_of_two_neighbours(const DualGraph& graph, const std::vector<int>& labels, int face) {
    std::map<int, int> neighbours;
    for (int i = graph.offsets[face]; i < graph.offsets[face + 1]; ++i) {
        const int edge = graph.incident[i];
        if (graph.edges[edge].is_virtual()) continue;
        const int label = labels[graph.other_face(edge, face)];
        if (label != labels[face] && ++neighbours[label] == 2) return label;
    }
    return labels[face];
}

}  // namespace

void merge_label_islands(const DualGraph& graph, int minimum_faces, std::vector<int>& labels) {
    // Every round ends at least one piece for good, so the rounds end.
    for (bool changed = true; changed;) {
        changed = false;
        std::vector<std::vector<int>> pieces = label_pieces(graph, labels);
        std::stable_sort(pieces.begin(), pieces.end(),
                         [](const auto& a, const auto& b) { return a.size() < b.size(); });
        for (const std::vector<int>& piece : pieces) {
            if (static_cast<int>(piece.size()) >= minimum_faces) break;
            const int label = surrounding_label(graph, labels, piece);
            if (label < 0) continue;
            for (const int face : piece) labels[face] = label;
            changed = true;
            break;
        }
    }
}

void remove_label_teeth(const DualGraph& graph, std::vector<int>& labels) {
    // Every change makes at least one boundary edge fewer, so the rounds end.
    for (bool changed = true; changed;) {
        changed = false;
        for (int face = 0; face < graph.face_count; ++face) {
            const int label = label_of_two_neighbours(graph, labels, face);
            changed = changed || label != labels[face];
            labels[face] = label;
        }
    }
}

}  // namespace coseg
