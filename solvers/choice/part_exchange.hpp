#pragma once
// Improves a partition by exchanging whole parts of a mesh, such as a head that is taken for an abdomen and
// the abdomen that is taken for a head.

#include <vector>

#include "solvers/choice/partition_objective.hpp"

namespace coseg {

/// One mesh after the other, the pieces into which the partition divides it are given to the parts by the
/// one-to-one assignment that raises the objective most while the other meshes stay as they are. The borders
/// inside a mesh stay where they are, and with them ties and what each mesh explains by itself; what changes
/// are the shares explained over all meshes, the size steadiness and the links. The objective never falls.
/// Ends when a round over all meshes changes nothing, at the latest after `rounds`. Serial; a function of the
/// arguments alone. labels: 0 .. parts-1 for each patch.
///
/// Source: Kuhn 1955 (the assignment).
std::vector<int> exchange_parts(const PartitionObjective& objective, std::vector<int> labels, int parts,
                                int rounds = 8);

}  // namespace coseg
