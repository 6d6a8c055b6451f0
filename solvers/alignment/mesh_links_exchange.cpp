#include "solvers/alignment/mesh_links_exchange.hpp"

#include <algorithm>
#include <cstddef>
#include <set>
#include <tuple>
#include <utility>

#include "src/base/index.hpp"
#include "src/base/seeded_random.hpp"
#include "src/parallel/owner_exchange.hpp"

namespace coseg {

namespace {

/// Every coefficient of this rank between two meshes, from both of its ends.
std::vector<PatchLink> links_of_columns(const LinkRequest& request) {
    const SparseCoefficients& w = request.coefficients;
    const std::vector<double> norms = pair_norms(w);
    std::vector<PatchLink> links;
    links.reserve(2 * norms.size());
    for (std::size_t c = 0; c + 1 < w.offsets.size(); ++c) {
        const auto j = static_cast<int>(w.columns.begin + static_cast<std::int64_t>(c));
        const auto begin = at(w.offsets[c]);
        const auto end = at(w.offsets[c + 1]);
        double total = 0.0;
        for (std::size_t e = begin; e < end; ++e) total += norms[e];
        if (!(total > 0.0)) continue;
        for (std::size_t e = begin; e < end; ++e) {
            const int i = w.rows[e];
            if (request.mesh_of[at(i)] == request.mesh_of[at(j)]) continue;
            const double weight = request.patch_area[at(j)] * norms[e] / total;
            links.push_back({i, j, weight});
            links.push_back({j, i, weight});
        }
    }
    return links;
}

/// Both meshes have the same number for the pair.
std::uint64_t pair_key(std::uint64_t a, std::uint64_t b) {
    return hash_words({std::min(a, b), std::max(a, b)});
}

void keep_first_partners(const LinkRequest& request, int mesh, std::vector<PatchLink>& links) {
    std::set<std::pair<std::uint64_t, int>> partners;
    for (const PatchLink& link : links) {
        const int other = request.mesh_of[at(link.other)];
        partners.emplace(pair_key(request.mesh_keys[at(mesh)], request.mesh_keys[at(other)]), other);
    }
    std::set<int> kept;
    for (const auto& [key, other] : partners) {
        if (std::ssize(kept) < request.most_partners) kept.insert(other);
    }
    std::erase_if(links,
                  [&](const PatchLink& link) { return !kept.contains(request.mesh_of[at(link.other)]); });
}

}  // namespace

LinksOfMeshes links_of_meshes(const Comm& comm, const LinkRequest& request) {
    LinksOfMeshes found;
    found.meshes = block_range(std::ssize(request.mesh_keys), comm.size(), comm.rank());
    found.links.resize(at(found.meshes.size()));
    const auto owner = [&](const PatchLink& link) {
        return block_owner(std::ssize(request.mesh_keys), comm.size(), request.mesh_of[at(link.own)]);
    };
    for (const PatchLink& link : sent_to_owners(comm, links_of_columns(request), owner, "links"))
        found.links[at(request.mesh_of[at(link.own)] - found.meshes.begin)].push_back(link);
    for (std::size_t m = 0; m < found.links.size(); ++m) {
        std::vector<PatchLink>& list = found.links[m];
        keep_first_partners(request, static_cast<int>(found.meshes.begin) + static_cast<int>(m), list);
        std::sort(list.begin(), list.end(), [](const PatchLink& a, const PatchLink& b) {
            return std::tie(a.own, a.other, a.weight) < std::tie(b.own, b.other, b.weight);
        });
    }
    return found;
}

}  // namespace coseg
