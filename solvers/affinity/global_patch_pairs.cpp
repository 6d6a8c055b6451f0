#include "solvers/affinity/global_patch_pairs.hpp"

#include <algorithm>
#include <string>
#include <tuple>
#include <utility>

#include "src/base/error.hpp"

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
std::vector<int> pair_numbers(const std::vector<Relation>& relations) {
    std::vector<int> numbers;
    for (const Relation& r : relations) numbers.insert(numbers.end(), {r.patch_a, r.patch_b});
    return numbers;
}

}  // namespace

std::vector<GlobalPatchNeighbors> gather_patch_pairs(const Comm& comm,
                                                     const std::vector<GlobalPatchNeighbors>& local,
                                                     int patches) {
    std::vector<double> weights;
    for (const GlobalPatchNeighbors& r : local)
        weights.insert(weights.end(), {r.boundary_length, r.concavity});
    const std::vector<int> pairs = all_gather(comm, std::span<const int>(pair_numbers(local)));
    const std::vector<double> all_weights = all_gather(comm, std::span<const double>(weights));
    std::vector<GlobalPatchNeighbors> all(pairs.size() / 2);
    for (std::size_t k = 0; k < all.size(); ++k) {
        all[k] = {pairs[2 * k], pairs[2 * k + 1], all_weights[2 * k], all_weights[2 * k + 1]};
    }
    sort_pairs(all);
    refuse_bad_pairs(all, patches);
    return all;
}

std::vector<GlobalPatchOverlap> gather_patch_pairs(const Comm& comm,
                                                   const std::vector<GlobalPatchOverlap>& local,
                                                   int patches) {
    std::vector<double> shares;
    for (const GlobalPatchOverlap& r : local) shares.push_back(r.intersection_over_union);
    const std::vector<int> pairs = all_gather(comm, std::span<const int>(pair_numbers(local)));
    const std::vector<double> all_shares = all_gather(comm, std::span<const double>(shares));
    std::vector<GlobalPatchOverlap> all(all_shares.size());
    for (std::size_t k = 0; k < all.size(); ++k) all[k] = {pairs[2 * k], pairs[2 * k + 1], all_shares[k]};
    sort_pairs(all);
    refuse_bad_pairs(all, patches);
    return all;
}

}  // namespace coseg
