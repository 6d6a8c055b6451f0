#pragma once
// Connected components of an affinity, and patches too weakly tied to be cut, which follow their neighbours
// instead.

#include <vector>

#include "solvers/affinity/sparse_rows.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

/// Per row of the symmetric `graph` the lowest row of its component; positive entries are edges. The same on
/// all ranks. Collective; each rank sends at most size - 1 edges, a spanning forest of its rows.
std::vector<int> connected_components(const Comm& comm, const SparseRows& graph);

/// The components that a cut into `parts` is about, largest first (ties: lowest row first), rows ascending in
/// each: those of at least 2 rows and of at least a twentieth of a part's even share of all rows, at most
/// `parts` of them; the largest alone if none is that large. Empty if no two rows are connected. Every other
/// row is "set aside": a cluster of its own would be the cheapest cut of all, and never a part of a shape.
std::vector<std::vector<int>> main_components(const std::vector<int>& component_of_row, int parts);

/// Gives every row of label -1 the label to which the complete, symmetric `within_mesh_affinity` tie it most, starting from
/// rows that have one and spreading in rounds (ties: lowest label). Returns how many rows no bond reaches:
/// these take `fallback`.
int attach_set_aside(std::vector<int>& labels, const SparseRows& within_mesh_affinity, int fallback);

}  // namespace coseg
