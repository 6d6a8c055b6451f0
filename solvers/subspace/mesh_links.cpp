#include "solvers/subspace/mesh_links.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>

#include "src/base/index.hpp"
#include "src/base/seeded_random.hpp"

namespace coseg {

namespace {

/// All meshes in the order of a hash; a tie of hashes is broken by the name.
std::vector<int> random_cycle(const std::vector<std::string>& names, std::uint64_t seed,
                              std::uint64_t cycle) {
    std::vector<std::uint64_t> key;
    for (const std::string& name : names) key.push_back(hash_words({seed, cycle, hash_text(name)}));
    std::vector<int> order(names.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](int a, int b) {
        const auto i = at(a);
        const auto j = at(b);
        return key[i] != key[j] ? key[i] < key[j] : names[i] < names[j];
    });
    return order;
}

/// Links the neighbours on a cycle that both still want links. Returns how many links that gave.
int add_cycle(const std::vector<int>& cycle, std::size_t wanted, std::vector<std::vector<int>>& links) {
    int added = 0;
    for (std::size_t k = 0; k < cycle.size(); ++k) {
        const int a = cycle[k];
        const int b = cycle[(k + 1) % cycle.size()];
        std::vector<int>& of_a = links[at(a)];
        std::vector<int>& of_b = links[at(b)];
        if (of_a.size() >= wanted || of_b.size() >= wanted) continue;
        if (std::find(of_a.begin(), of_a.end(), b) != of_a.end()) continue;
        of_a.push_back(b);
        of_b.push_back(a);
        ++added;
    }
    return added;
}

}  // namespace

std::vector<std::vector<int>> mesh_links(const std::vector<std::string>& names, int links,
                                         std::uint64_t seed) {
    const auto wanted = at(links);
    if (wanted + 1 >= names.size()) return {};
    std::vector<std::vector<int>> result(names.size());
    std::size_t missing = names.size() * wanted / 2;
    // Half as many cycles as links would be enough if no two cycles shared a link and none met a mesh that
    // has enough links.
    const std::size_t most_cycles = 4 * wanted + 16;
    for (std::uint64_t cycle = 0; cycle < most_cycles && missing > 0; ++cycle) {
        missing -= at(add_cycle(random_cycle(names, seed, cycle), wanted, result));
    }
    for (std::vector<int>& of_mesh : result) std::sort(of_mesh.begin(), of_mesh.end());
    return result;
}

}  // namespace coseg
