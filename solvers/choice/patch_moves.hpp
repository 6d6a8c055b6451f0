#pragma once
// Improves a partition by moving single patches between parts.

#include <vector>

#include "solvers/choice/partition_objective.hpp"

namespace coseg {

struct MovedPatches {
    std::vector<int> labels;  ///< of every patch
    int moved = 0;            ///< number of moves
};

/// In each round every mesh makes the one move of a patch to the part of a patch that it is tied or linked to
/// which raises the objective most, with the sums over all meshes as they stood before the round. A mesh
/// without such a move is done. Ends when all are, at the latest after `rounds`. Meshes that move at once may
/// undo each other's gains, so the caller compares the scores before and after. No part loses its last patch.
/// Serial; a function of the arguments alone. labels: 0 .. parts-1 for each patch.
MovedPatches move_patches(const PartitionObjective& objective, std::vector<int> labels, int parts,
                          int rounds = 12);

}  // namespace coseg
