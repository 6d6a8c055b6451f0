#pragma once
// Improves a partition by moves of many patches at once: in each mesh the best set of patches that take a
// part together, found by minimum cuts.

#include <Eigen/Core>
#include <array>
#include <functional>
#include <span>
#include <vector>

#include "solvers/choice/partition_objective.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

/// What is known of the parts of patches beside the objective.
struct KnownParts {
    std::vector<int> fixed;  ///< the part of each patch that keeps it, -1 of the others; empty: none is fixed
    Eigen::MatrixXd gain;    ///< parts x N: what a patch gains in a part; 0 x 0: nothing
};

/// The labels after one round. The terms of the objective that are no ties inside a mesh (explained shares,
/// size steadiness, links to other meshes) are replaced by their first derivative at `labels`, which makes
/// them gains of single patches. With these gains and the ties, each mesh then lets one part after the other
/// expand: the set of patches that goes over to the part is the best of all sets. Every rank works on a block
/// of the meshes; the result has the same bytes on any number of ranks. As derivatives are no differences,
/// the objective may fall; the caller compares. With `inertia` a patch gains so much by keeping its part,
/// times its share of the area of all meshes: changes stay near the labels at which the derivatives were
/// taken.
/// labels: 0 .. parts-1 of each patch. Collective.
///
/// Source: Boykov, Veksler and Zabih 2001, "Fast approximate energy minimization via graph cuts" (expansion).
std::vector<int> expand_parts(const Comm& comm, const PartitionObjective& objective, const KnownParts& known,
                              const std::vector<int>& labels, int parts, double inertia = 0.0);

/// The inertias of a climb from labels that were found by other moves.
inline constexpr std::array falling_inertias{20.0, 10.0, 5.0, 0.0};
inline constexpr std::array no_inertia{0.0};

/// What a climb follows.
struct Climb {
    std::function<double(const std::vector<int>&)> score;  ///< of labels; the same function on all ranks
    std::span<const double> inertias = no_inertia;
};

/// Rounds of expand_parts with the first of the inertias as long as the score rises, at most 15; then with
/// the next. Collective.
std::vector<int> climb_by_expansion(const Comm& comm, const PartitionObjective& objective,
                                    const KnownParts& known, std::vector<int> labels, int parts,
                                    const Climb& climb);

}  // namespace coseg
