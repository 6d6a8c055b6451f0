#include "src/patches/face_labels.hpp"

#include <algorithm>
#include <string>

#include "src/base/error.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

constexpr int undecided = -1;

int checked_part(const std::vector<std::vector<int>>& part_of_patch, std::size_t o, int patch, int parts) {
    const bool has_part = o < part_of_patch.size() && patch >= 0 && at(patch) < part_of_patch[o].size();
    const int part = has_part ? part_of_patch[o][at(patch)] : undecided;
    if (part < 0 || part >= parts) {
        throw Error(ExitCode::internal, "patch " + std::to_string(patch) + " of over-segmentation " +
                                            std::to_string(o) + " has no part in 0.." +
                                            std::to_string(parts - 1));
    }
    return part;
}

/// The parts with the most votes, ascending.
std::vector<int> most_frequent(const std::vector<int>& votes) {
    const int most = *std::max_element(votes.begin(), votes.end());
    std::vector<int> parts;
    for (std::size_t p = 0; p < votes.size(); ++p) {
        if (votes[p] == most) parts.push_back(static_cast<int>(p));
    }
    return parts;
}

struct WaitingFace {
    int face;
    std::vector<int> candidates;  // ascending
};

/// The candidate with the most shared edge length to decided faces; undecided if no such face has a candidate
/// part.
int part_by_neighbors(const DualGraph& graph, const std::vector<int>& label, const WaitingFace& waiting) {
    std::vector<double> shared(waiting.candidates.size(),
                               -1.0);  // -1: no such neighbour; 0: an edge without length
    const auto f = at(waiting.face);
    for (int k = graph.offsets[f]; k < graph.offsets[f + 1]; ++k) {
        const int e = graph.incident[at(k)];
        const int part = label[at(graph.other_face(e, waiting.face))];
        const auto place = std::lower_bound(waiting.candidates.begin(), waiting.candidates.end(), part);
        if (place == waiting.candidates.end() || *place != part) continue;
        double& length = shared[at(place - waiting.candidates.begin())];
        length = std::max(length, 0.0) + graph.edges[at(e)].length;
    }
    const auto most = std::max_element(shared.begin(), shared.end());
    return *most < 0.0 ? undecided : waiting.candidates[at(most - shared.begin())];
}

/// One round; returns whether any waiting face was decided.
bool decide_by_neighbors(const DualGraph& graph, std::vector<int>& label, std::vector<WaitingFace>& waiting) {
    std::vector<int> decision(waiting.size());
    for (std::size_t w = 0; w < waiting.size(); ++w)
        decision[w] = part_by_neighbors(graph, label, waiting[w]);
    std::vector<WaitingFace> still;
    for (std::size_t w = 0; w < waiting.size(); ++w) {
        label[at(waiting[w].face)] = decision[w];
        if (decision[w] == undecided) still.push_back(waiting[w]);
    }
    const bool any = still.size() < waiting.size();
    waiting = std::move(still);
    return any;
}

}  // namespace

std::vector<int> vote_face_labels(const std::vector<std::vector<int>>& oversegmentations,
                                  const std::vector<std::vector<int>>& part_of_patch, int parts,
                                  const DualGraph& graph) {
    if (oversegmentations.empty())
        throw Error(ExitCode::internal, "a vote needs at least one over-segmentation");
    std::vector<int> label(at(graph.face_count), undecided);
    std::vector<WaitingFace> waiting;
    std::vector<int> votes;
    for (std::size_t f = 0; f < label.size(); ++f) {
        votes.assign(at(parts), 0);
        for (std::size_t o = 0; o < oversegmentations.size(); ++o) {
            ++votes[at(checked_part(part_of_patch, o, oversegmentations[o][f], parts))];
        }
        std::vector<int> candidates = most_frequent(votes);
        if (candidates.size() == 1) {
            label[f] = candidates.front();
        } else {
            waiting.push_back({static_cast<int>(f), std::move(candidates)});
        }
    }
    while (!waiting.empty() && decide_by_neighbors(graph, label, waiting)) {
    }
    for (const WaitingFace& w : waiting) label[at(w.face)] = w.candidates.front();
    return label;
}

}  // namespace coseg
