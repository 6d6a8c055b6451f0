#pragma once
// Draws a sample of the collection's faces that depends on the meshes alone, not on which rank holds them.

#include <cstdint>
#include <vector>

#include "src/base/seeded_random.hpp"

namespace coseg {

/// The probability with which about `wanted` of `faces` faces are taken; 1 where all of them are.
constexpr double sampling_share(std::int64_t wanted, std::int64_t faces) noexcept {
    return faces <= wanted ? 1.0 : static_cast<double>(wanted) / static_cast<double>(faces);
}

/// The faces of one mesh in the sample, ascending: each face with probability `share`, by a hash of seed,
/// mesh and face. mesh_key = hash_text(name of the mesh).
inline std::vector<int> hashed_sample(std::uint64_t seed, std::uint64_t mesh_key, int faces, double share) {
    std::vector<int> chosen;
    for (int f = 0; f < faces; ++f) {
        if (uniform_of(hash_words({seed, mesh_key, static_cast<std::uint64_t>(f)})) < share)
            chosen.push_back(f);
    }
    return chosen;
}

}  // namespace coseg
