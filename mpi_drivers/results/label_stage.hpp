#pragma once
// Gives every input face a part from the parts of patches, on the rank that holds the mesh.

#include <vector>

#include "mpi_drivers/describe/mesh_stage.hpp"
#include "mpi_drivers/options/stage_options.hpp"
#include "src/parallel/stage_log.hpp"

namespace coseg {

struct MeshLabels {
    int mesh = 0;
    std::vector<int> part;          ///< per input face, 0..K-1
    std::vector<int> patch;         ///< per input face, patch of the first over-segmentation
    std::vector<double> part_area;  ///< K, shares of the mesh's area; 0 for a part that no face has
};

/// Labels of this rank's meshes, voted and refined. part_of_patch: N, all patches, 0 .. parts - 1. `given`:
/// GivenLabels::faces, which faces keep. The log has the stage "label". Collective.
std::vector<MeshLabels> label_faces(const Collection& collection, const std::vector<int>& part_of_patch,
                                    int parts, RefineMode refine, StageLog& log,
                                    const std::vector<std::vector<int>>& given = {});

}  // namespace coseg
