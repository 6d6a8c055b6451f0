#pragma once
// How sure the part of each patch is.

#include <vector>

#include "solvers/choice/part_expansion.hpp"
#include "solvers/choice/partition_objective.hpp"

namespace coseg {

/// For each patch the probability, in [0, 1], that its part is right:
///     1 / (1 + exp(7.84 - 1.26 tanh(m / 60) - 10.0 a)).
/// The margin m is what the patch gains in its part more than in the next best one, by the terms that are no
/// ties and by `known`, as if it had the area of a mesh. a is the share of its ties (overlaps, creases,
/// links) that lead to patches of its part, by weight. A fixed patch has 1. labels: 0 .. parts-1. Serial; a
/// function of the arguments alone.
///
/// Source: none; a logistic regression on eleven labelled sets, see docs/method.md, section 8.
std::vector<double> part_confidence(const PartitionObjective& objective, const KnownParts& known,
                                    const std::vector<int>& labels, int parts);

}  // namespace coseg
