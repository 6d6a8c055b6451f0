#include "solvers/affinity/graph_components.hpp"

#include <algorithm>
#include <map>
#include <span>

#include "src/base/disjoint_sets.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

void join_rows(const SparseRows& graph, DisjointSets& sets) {
    for (std::size_t r = 0; r < at(graph.local_rows()); ++r) {
        for (auto k = at(graph.offsets[r]); k < at(graph.offsets[r + 1]); ++k) {
            if (graph.values[k] > 0.0)
                sets.join(static_cast<int>(graph.rows.begin) + static_cast<int>(r), graph.columns[k]);
        }
    }
}

void join_over_ranks(const Comm& comm, int size, DisjointSets& sets) {
    std::vector<int> forest;
    for (int i = 0; i < size; ++i) {
        if (const int root = sets.lowest(i); root != i) forest.insert(forest.end(), {i, root});
    }
    const std::vector<int> edges = all_gather(comm, std::span<const int>(forest));
    for (std::size_t k = 0; k < edges.size(); k += 2) sets.join(edges[k], edges[k + 1]);
}

/// Per label the within_mesh_affinity from `row` to rows that have it; the heaviest label, or -1.
int heaviest_label(const SparseRowsView& within_mesh_affinity, std::size_t row,
                   const std::vector<int>& labels) {
    std::map<int, double> weight;
    for (auto k = at(within_mesh_affinity.offsets[row]); k < at(within_mesh_affinity.offsets[row + 1]); ++k) {
        const int label = labels[at(within_mesh_affinity.columns[k])];
        if (label >= 0 && within_mesh_affinity.values[k] > 0.0)
            weight[label] += within_mesh_affinity.values[k];
    }
    int best = -1;
    double most = 0.0;
    for (const auto& [label, sum] : weight) {
        if (sum > most) {
            best = label;
            most = sum;
        }
    }
    return best;
}

}  // namespace

std::vector<int> connected_components(const Comm& comm, const SparseRows& graph) {
    const auto size = static_cast<int>(graph.size);
    DisjointSets sets(at(size));
    join_rows(graph, sets);
    if (comm.size() > 1) join_over_ranks(comm, size, sets);
    std::vector<int> component(at(size));
    for (int i = 0; i < size; ++i) component[at(i)] = sets.lowest(i);
    return component;
}

std::vector<std::vector<int>> main_components(const std::vector<int>& component_of_row, int parts) {
    constexpr double share_of_a_part = 0.05;
    std::map<int, std::vector<int>> members;
    for (std::size_t i = 0; i < component_of_row.size(); ++i) {
        members[component_of_row[i]].push_back(static_cast<int>(i));
    }
    std::vector<std::vector<int>> sorted;
    for (auto& [root, rows] : members) {
        if (rows.size() >= 2) sorted.push_back(std::move(rows));
    }
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const auto& a, const auto& b) { return a.size() > b.size(); });
    const double least = share_of_a_part * static_cast<double>(component_of_row.size()) / parts;
    std::size_t kept = 0;
    while (kept < sorted.size() && kept < at(parts) &&
           (kept == 0 || static_cast<double>(sorted[kept].size()) >= least)) {
        ++kept;
    }
    sorted.resize(kept);
    return sorted;
}

int attach_set_aside(std::vector<int>& labels, const SparseRowsView& within_mesh_affinity, int fallback) {
    std::vector<std::size_t> waiting;
    for (std::size_t i = 0; i < labels.size(); ++i) {
        if (labels[i] < 0) waiting.push_back(i);
    }
    while (!waiting.empty()) {
        const std::vector<int> before = labels;
        for (const std::size_t i : waiting) labels[i] = heaviest_label(within_mesh_affinity, i, before);
        const std::size_t count = waiting.size();
        std::erase_if(waiting, [&](std::size_t i) { return labels[i] >= 0; });
        if (waiting.size() == count) break;
    }
    for (const std::size_t i : waiting) labels[i] = fallback;
    return static_cast<int>(waiting.size());
}

}  // namespace coseg
