#pragma once
// Which mesh a person should look at next: where an answer would help most.

#include <vector>

#include "solvers/choice/partition_objective.hpp"

namespace coseg {

/// What an answer about a mesh is expected to bring.
struct OpenQuestion {
    double own = 0.0;     ///< the share of the mesh's area that is expected to be wrong
    double others = 0.0;  ///< the area in doubt elsewhere that leans on what is in doubt here, in meshes
    int followers = 0;    ///< other meshes of which at least a hundredth does so
    int patch = -1;       ///< the patch with most of both
    [[nodiscard]] double value() const { return own + others; }
};

/// Of each mesh. A patch i is in doubt by d_i = 1 - confidence. Its own share is its area times d_i. Each
/// patch j of another mesh that is in doubt leans on those that it is linked to, by their shares of its
/// links; what leans on patch i counts a_j d_j times that share times d_i, because an answer about what is
/// sure teaches nothing. `is_closed`: meshes of which all is said; they have no value, and nobody follows
/// there. Serial; a function of the arguments alone.
///
/// Source: none; expected error reduction (Roy and McCallum 2001) over one step along the links.
std::vector<OpenQuestion> open_questions(const PartitionObjective& objective,
                                         const std::vector<double>& confidence,
                                         const std::vector<bool>& is_closed);

/// The mesh with the largest value, of equal ones the first; -1 where all are closed.
int next_question(const std::vector<OpenQuestion>& questions, const std::vector<bool>& is_closed);

}  // namespace coseg
