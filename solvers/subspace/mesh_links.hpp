#pragma once
// Chooses in which meshes the patches of a mesh may have matches: a sparse, connected graph over meshes.

#include <cstdint>
#include <string>
#include <vector>

namespace coseg {

/// Above this number of meshes each one is linked to `default_links` others, unless more are asked for.
/// Measured in docs/method.md.
inline constexpr int meshes_linked_to_all = 128;
inline constexpr int default_links = 32;

/// For each mesh the meshes that it is linked to, ascending: SubspaceProblem::allowed_meshes. The result is
/// empty, which means all other meshes, where `links` is at least one less than the number of meshes.
///
/// The links are those of random cycles through all meshes. They are symmetric, and the first cycle alone
/// connects all meshes. A union of a few such cycles is an expander with high probability, so that the cut's
/// graph has no cheap cut between sets of meshes. Each mesh gets `links` of them; a few may get one or two
/// less. The order of a cycle is a hash of the seed and the meshes' names. `links` >= 2; `names` are unique.
/// Does not communicate.
///
/// Source: the union of random Hamiltonian cycles and its expansion: Friedman 2008; Kim and Wormald 2001.
std::vector<std::vector<int>> mesh_links(const std::vector<std::string>& names, int links,
                                         std::uint64_t seed);

}  // namespace coseg
