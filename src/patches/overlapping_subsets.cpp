#include "src/patches/overlapping_subsets.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/base/seeded_random.hpp"

namespace coseg {

OverlappingSubsets overlapping_subsets(const std::vector<std::string>& names, int size, std::uint64_t seed) {
    if (size < 4) throw Error(ExitCode::usage, "a subset of a collection needs at least 4 shapes");
    const int meshes = static_cast<int>(names.size());
    std::vector<std::pair<std::uint64_t, int>> dealt;
    for (int m = 0; m < meshes; ++m) dealt.emplace_back(hash_words({seed, hash_text(names[at(m)])}), m);
    std::sort(dealt.begin(), dealt.end());
    OverlappingSubsets plan;
    const int common = meshes <= size ? meshes : std::max(2, size / 3);
    for (int k = 0; k < common; ++k) plan.common.push_back(dealt[at(k)].second);
    std::sort(plan.common.begin(), plan.common.end());
    const int own = size - common;
    const int count = meshes <= size ? 1 : (meshes - common + own - 1) / own;
    plan.subsets.assign(at(count), plan.common);
    for (int k = common; k < meshes; ++k)
        plan.subsets[at((k - common) % count)].push_back(dealt[at(k)].second);
    for (std::vector<int>& subset : plan.subsets) std::sort(subset.begin(), subset.end());
    return plan;
}

}  // namespace coseg
