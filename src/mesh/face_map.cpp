#include "src/mesh/face_map.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <string>
#include <utility>

#include "src/base/error.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

/// Working faces grouped by input face: members[offsets[f] .. offsets[f+1]), ascending.
struct WorkingFaces {
    std::vector<int> offsets;
    std::vector<int> members;
};

WorkingFaces group_by_input_face(const FaceMap& map) {
    WorkingFaces group;
    group.offsets.assign(at(map.input_faces) + 1, 0);
    for (const int f : map.input_face) ++group.offsets[at(f) + 1];
    for (std::size_t f = 1; f < group.offsets.size(); ++f) group.offsets[f] += group.offsets[f - 1];
    group.members.resize(map.input_face.size());
    std::vector<int> next(group.offsets.begin(), group.offsets.end() - 1);
    for (std::size_t w = 0; w < map.input_face.size(); ++w) {
        group.members[at(next[at(map.input_face[w])]++)] = static_cast<int>(w);
    }
    return group;
}

/// The label with the largest sum of area; `shares` holds (label, area) of one input face's working faces.
int largest_label(std::vector<std::pair<int, double>>& shares) {
    std::stable_sort(shares.begin(), shares.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    int best_label = shares.front().first;
    double best_area = -1.0;
    for (std::size_t begin = 0, end = 0; begin < shares.size(); begin = end) {
        double area = 0.0;
        for (; end < shares.size() && shares[end].first == shares[begin].first; ++end)
            area += shares[end].second;
        if (area > best_area) {
            best_area = area;
            best_label = shares[begin].first;
        }
    }
    return best_label;
}

int end_of_chain(const FaceMap& map, int face) {
    for (int step = 0; step <= map.input_faces; ++step) {
        const int next = map.label_donor[at(face)];
        if (next < 0 || next >= map.input_faces) break;
        if (next == face) return face;
        face = next;
    }
    throw Error(ExitCode::internal,
                "the label donor of input face " + std::to_string(face) + " leads to no labelled face");
}

}  // namespace

std::vector<int> carry_labels_back(const FaceMap& map, const std::vector<int>& working_labels,
                                   const Eigen::VectorXd& working_area) {
    if (working_labels.size() != map.input_face.size() ||
        at(static_cast<int>(working_area.size())) != map.input_face.size() ||
        map.label_donor.size() != at(map.input_faces) ||
        (!map.nearest_working.empty() && map.nearest_working.size() != at(map.input_faces))) {
        throw Error(ExitCode::internal, "labels, areas and face map have different numbers of working faces");
    }
    const WorkingFaces group = group_by_input_face(map);
    std::vector<int> labels(at(map.input_faces), 0);
    std::vector<std::pair<int, double>> shares;
    for (int f = 0; f < map.input_faces; ++f) {
        shares.clear();
        for (int k = group.offsets[at(f)]; k < group.offsets[at(f) + 1]; ++k) {
            const int w = group.members[at(k)];
            shares.emplace_back(working_labels[at(w)], working_area[w]);
        }
        if (!shares.empty()) {
            labels[at(f)] = largest_label(shares);
        } else if (!map.nearest_working.empty() && map.nearest_working[at(f)] >= 0) {
            labels[at(f)] = working_labels[at(map.nearest_working[at(f)])];
        }
    }
    const auto has_label = [&](int f) {
        return group.offsets[at(f)] != group.offsets[at(f) + 1] ||
               (!map.nearest_working.empty() && map.nearest_working[at(f)] >= 0);
    };
    for (int f = 0; f < map.input_faces; ++f) {
        if (has_label(f)) continue;
        const int source = end_of_chain(map, f);
        if (!has_label(source)) {
            throw Error(ExitCode::internal,
                        "input face " + std::to_string(source) + " has no working face to take a label from");
        }
        labels[at(f)] = labels[at(source)];
    }
    return labels;
}

std::vector<int> main_working_faces(const FaceMap& map, const Eigen::VectorXd& working_area) {
    std::vector<int> itself(map.input_face.size());
    std::iota(itself.begin(), itself.end(), 0);
    return carry_labels_back(map, itself, working_area);
}

}  // namespace coseg
