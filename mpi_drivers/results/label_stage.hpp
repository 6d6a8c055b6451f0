#pragma once
// From parts of patches to one part per input face, on the rank that holds the mesh.

#include <vector>

#include "mpi_drivers/describe/mesh_stage.hpp"
#include "mpi_drivers/options/run_options.hpp"

namespace coseg {

struct MeshLabels {
    int mesh = 0;
    std::vector<int> part;          ///< per input face, 0..K-1
    std::vector<int> patch;         ///< per input face, patch of the first over-segmentation
    std::vector<double> part_area;  ///< K, shares of the mesh's area
};

/// Labels of this rank's meshes, voted and refined as options.refine says. part_of_patch: N, all patches. Not
/// collective.
std::vector<MeshLabels> label_faces(const Collection& collection, const std::vector<int>& part_of_patch,
                                    const RunOptions& options);

}  // namespace coseg
