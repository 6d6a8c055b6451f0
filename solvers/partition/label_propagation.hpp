#pragma once
// Finds the parts of a mesh's patches from their links to patches whose parts are known, and from what ties
// them to each other.

#include <Eigen/Core>
#include <vector>

#include "solvers/affinity/global_patch_pairs.hpp"

namespace coseg {

struct PropagationInput {
    /// K x n: the share of each patch's links that goes to patches of each known part. Columns sum to 1, or
    /// are 0 for a patch without links.
    Eigen::MatrixXd evidence;
    std::vector<GlobalPatchNeighbors> neighbors;  ///< patches 0 .. n - 1 of one mesh
    std::vector<GlobalPatchOverlap> overlaps;     ///< likewise
    /// Of each patch the part that it is known to have, or -1; empty where nothing is known of any.
    std::vector<int> known = {};
};

/// The part of each patch. Known parts, of the patches that links lead to and of this mesh, are held, and the
/// others take the minimum of the same quadratic form
/// as the cut's, sum over pairs of S_ij ||f_i - f_j||^2, in the graph S = C + g (A + O) of affinity.hpp. Here
/// g = `within_mesh_affinity`, and A and O are scaled to the total of C. A patch takes the part of its
/// largest value, the lowest one if several are equal. Patches without any tie to a known part get -1.
/// Serial. Throws Error(internal) for sizes that do not fit.
///
/// Source: Zhu, Ghahramani, Lafferty 2003 (harmonic functions). It is the cut's relaxation with known labels.
std::vector<int> propagate_labels(const PropagationInput& input, double within_mesh_affinity);

}  // namespace coseg
