#pragma once
// Finds the connected components of an affinity. Patches that are too weakly tied to be cut follow their
// neighbours instead.

#include <vector>

#include "solvers/affinity/sparse_rows.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

/// For each row of the symmetric `graph` the lowest row of its component; positive entries are edges. The
/// result is the same on all ranks. Collective; each rank sends at most size - 1 edges, a spanning forest of
/// its rows.
std::vector<int> connected_components(const Comm& comm, const SparseRows& graph);

/// The components that take part in a cut into `parts`, largest first (of equal ones the one with the lowest
/// row), with ascending rows. They are those of at least 2 rows and of at least a twentieth of a part's even
/// share of all rows, and at most `parts` of them; if none is that large, the largest alone. The result is
/// empty if no two rows are connected. Every other row is set aside: a cluster of its own would be the
/// cheapest cut of all, and never a part of a shape.
std::vector<std::vector<int>> main_components(const std::vector<int>& component_of_row, int parts);

/// Gives every row of label -1 the label to which the complete, symmetric `within_mesh_affinity` ties it
/// most. The labels spread in rounds from the rows that have one; of equal ties the lowest label is taken.
/// Returns the number of rows that no affinity reaches: these take `fallback`.
int attach_set_aside(std::vector<int>& labels, const SparseRowsView& within_mesh_affinity, int fallback);

}  // namespace coseg
