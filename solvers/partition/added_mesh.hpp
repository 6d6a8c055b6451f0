#pragma once
// Finds the parts of a mesh that joins others whose parts are known.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "solvers/affinity/global_patch_pairs.hpp"
#include "solvers/affinity/sparse_rows.hpp"
#include "solvers/choice/partition_terms.hpp"
#include "solvers/partition/labelled_parts.hpp"
#include "src/records/start_outcome.hpp"

namespace coseg {

/// The patches of the known meshes, N of them, and then those of the added one, n.
struct AddedMesh {
    std::vector<GlobalPatchNeighbors> neighbors;    ///< of the added mesh, whose first patch is N
    std::vector<GlobalPatchOverlap> overlaps;       ///< likewise
    std::span<const ChoiceDescriptor> descriptors;  ///< of all N + n patches
    std::vector<int> mesh_of;                       ///< N + n: 0 .. M, where M is the added mesh
    std::vector<double> patch_area;                 ///< N + n
    SparseRows links;                               ///< all rows; between the added mesh and the others only
    std::vector<int> known_parts;                   ///< N: 0 .. K-1
    Eigen::MatrixXd scores;  ///< K x n: how well each part suits the added patches, see PartRegression
    Eigen::MatrixXd said;    ///< K x n: the area that is said to have the part; zeros where nothing is said
};

/// Of the n patches of the added mesh.
struct AddedParts {
    std::vector<int> parts;
    std::vector<double> confidence;  ///< see part_confidence
};

/// Climbs the objective of the cut as if the added mesh had been in the run, with the parts of the known
/// patches held and the scores as gains, see corrected_partition: from the parts to which the links of each
/// patch lead, and from those with the best scores. Added patches of which at least half is said keep that
/// part. `weights` are those of a run of these meshes. Serial; a function of the arguments alone.
AddedParts added_parts(const AddedMesh& mesh, const ChoiceWeights& weights, const ExampleWeights& gains);

}  // namespace coseg
