#include "solvers/alignment/mesh_links_exchange.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>

#include "src/base/index.hpp"
#include "src/base/seeded_random.hpp"

namespace coseg {

namespace {

/// Calls visit(i, j, weight) for every coefficient of this rank between two meshes.
template <class Visit>
void for_each_coefficient(const LinkRequest& request, Visit&& visit) {
    const SparseCoefficients& w = request.coefficients;
    const auto features = at(w.features);
    std::vector<double> norms;
    for (std::size_t c = 0; c + 1 < w.offsets.size(); ++c) {
        const auto j = static_cast<int>(w.columns.begin + static_cast<std::int64_t>(c));
        norms.clear();
        double total = 0.0;
        for (auto e = at(w.offsets[c]); e < at(w.offsets[c + 1]); ++e) {
            double squares = 0.0;
            for (std::size_t h = 0; h < features; ++h)
                squares += w.values[e * features + h] * w.values[e * features + h];
            norms.push_back(std::sqrt(squares));
            total += norms.back();
        }
        if (!(total > 0.0)) continue;
        for (std::size_t k = 0; k < norms.size(); ++k) {
            const int i = w.rows[at(w.offsets[c]) + k];
            if (request.mesh_of[at(i)] != request.mesh_of[at(j)])
                visit(i, j, request.patch_area[at(j)] * norms[k] / total);
        }
    }
}

/// Entries for one rank after the other, as MPI_Alltoallv wants them.
struct Outgoing {
    std::vector<PatchLink> links;
    std::vector<int> counts;
    std::vector<int> starts;
};

Outgoing sorted_by_rank(const Comm& comm, const LinkRequest& request) {
    const auto meshes = std::ssize(request.mesh_keys);
    const auto owner = [&](int patch) {
        return at(block_owner(meshes, comm.size(), request.mesh_of[at(patch)]));
    };
    Outgoing out{{}, std::vector<int>(at(comm.size()), 0), std::vector<int>(at(comm.size()), 0)};
    for_each_coefficient(request, [&](int i, int j, double) {
        ++out.counts[owner(i)];
        ++out.counts[owner(j)];
    });
    std::exclusive_scan(out.counts.begin(), out.counts.end(), out.starts.begin(), 0);
    std::vector<int> next = out.starts;
    out.links.resize(at(out.starts.back() + out.counts.back()));
    for_each_coefficient(request, [&](int i, int j, double weight) {
        out.links[at(next[owner(i)]++)] = {i, j, weight};
        out.links[at(next[owner(j)]++)] = {j, i, weight};
    });
    return out;
}

std::vector<PatchLink> exchanged(const Comm& comm, const Outgoing& out) {
    std::vector<int> counts(out.counts.size());
    MPI_Alltoall(out.counts.data(), 1, MPI_INT, counts.data(), 1, MPI_INT, comm.raw());
    std::vector<int> starts(counts.size());
    std::exclusive_scan(counts.begin(), counts.end(), starts.begin(), 0);
    std::vector<PatchLink> mine(at(starts.back() + counts.back()));
    MPI_Datatype type = MPI_DATATYPE_NULL;
    MPI_Type_contiguous(static_cast<int>(sizeof(PatchLink)), MPI_BYTE, &type);
    MPI_Type_commit(&type);
    MPI_Alltoallv(out.links.data(), out.counts.data(), out.starts.data(), type, mine.data(), counts.data(),
                  starts.data(), type, comm.raw());
    MPI_Type_free(&type);
    return mine;
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
    for (const PatchLink& link : exchanged(comm, sorted_by_rank(comm, request)))
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
