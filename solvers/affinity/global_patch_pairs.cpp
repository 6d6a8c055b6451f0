#include "solvers/affinity/global_patch_pairs.hpp"

#include <algorithm>
#include <string>
#include <tuple>
#include <utility>

#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/parallel/record_exchange.hpp"

namespace coseg {

namespace {

template <class Relation>
void sort_pairs(std::vector<Relation>& relations) {
    for (Relation& r : relations) {
        if (r.patch_a > r.patch_b) std::swap(r.patch_a, r.patch_b);
    }
    std::sort(relations.begin(), relations.end(), [](const Relation& x, const Relation& y) {
        return std::tie(x.patch_a, x.patch_b) < std::tie(y.patch_a, y.patch_b);
    });
}

/// Every rank sees the same list, so every rank throws or none does.
template <class Relation>
void refuse_bad_pairs(const std::vector<Relation>& sorted, int patches) {
    for (std::size_t k = 0; k < sorted.size(); ++k) {
        const Relation& r = sorted[k];
        const std::string pair = std::to_string(r.patch_a) + " and " + std::to_string(r.patch_b);
        if (r.patch_a < 0 || r.patch_b >= patches || r.patch_a == r.patch_b) {
            throw AgreedError(ExitCode::internal, "the pair of patches " + pair + " is not within the " +
                                                      std::to_string(patches) + " patches");
        }
        if (k > 0 && sorted[k - 1].patch_a == r.patch_a && sorted[k - 1].patch_b == r.patch_b) {
            throw AgreedError(ExitCode::internal, "the pair of patches " + pair + " is given twice");
        }
    }
}

template <class Relation>
std::vector<Relation> gathered(const Comm& comm, const std::vector<Relation>& local, int patches) {
    std::vector<Relation> all = all_gather_records(comm, local);
    sort_pairs(all);
    refuse_bad_pairs(all, patches);
    return all;
}

}  // namespace

std::vector<GlobalPatchNeighbors> gather_patch_pairs(const Comm& comm,
                                                     const std::vector<GlobalPatchNeighbors>& local,
                                                     int patches) {
    return gathered(comm, local, patches);
}

std::vector<GlobalPatchOverlap> gather_patch_pairs(const Comm& comm,
                                                   const std::vector<GlobalPatchOverlap>& local,
                                                   int patches) {
    return gathered(comm, local, patches);
}

int mesh_count(const std::vector<int>& mesh_of) {
    return mesh_of.empty() ? 0 : *std::max_element(mesh_of.begin(), mesh_of.end()) + 1;
}

std::vector<std::vector<WeightedNeighbor>> weighted_neighbors(const std::vector<GlobalPatchNeighbors>& pairs,
                                                              int patches) {
    std::vector<std::vector<WeightedNeighbor>> of(at(patches));
    for (const GlobalPatchNeighbors& pair : pairs) {
        of[at(pair.patch_a)].push_back({pair.patch_b, pair.boundary_length});
        of[at(pair.patch_b)].push_back({pair.patch_a, pair.boundary_length});
    }
    for (std::vector<WeightedNeighbor>& neighbors : of) {
        double sum = 0.0;
        for (const WeightedNeighbor& n : neighbors) sum += n.weight;
        for (WeightedNeighbor& n : neighbors) n.weight = sum > 0.0 ? n.weight / sum : 0.0;
    }
    return of;
}

}  // namespace coseg
