#pragma once
// Gives every input face a part from the parts of patches, on the rank that holds the mesh.

#include <vector>

#include "mpi_drivers/describe/mesh_stage.hpp"
#include "mpi_drivers/options/stage_options.hpp"
#include "src/parallel/stage_log.hpp"
#include "src/records/cut_result.hpp"

namespace coseg {

struct MeshLabels {
    int mesh = 0;
    std::vector<int> part;   ///< per input face, 0..K-1
    std::vector<int> patch;  ///< per input face, patch of the first over-segmentation
    /// Per input face, the probability that its part is right; empty where the cut says none.
    std::vector<float> confidence;
    std::vector<double> part_area;  ///< K, shares of the mesh's area; 0 for a part that no face has
};

struct FaceLabelling {
    int parts = 0;  ///< K
    RefineMode refine = RefineMode::scored;
};

/// Labels of this rank's meshes, voted and refined, from the parts of all patches, 0 .. parts - 1. The
/// confidence of a face is the mean over the over-segmentations of the probability that its part is right: c
/// of a patch of this part, and (1 - c) / (parts - 1) of another; 1 for a face whose label is given. `given`:
/// GivenLabels::faces, which faces keep. The log has the stage "label". Collective.
std::vector<MeshLabels> label_faces(const Comm& comm, const Collection& collection, const CutResult& cut,
                                    FaceLabelling labelling, StageLog& log,
                                    const std::vector<std::vector<int>>& given = {});

/// The same for one mesh; given: what is said of its faces, or empty. Serial.
MeshLabels labels_of_mesh(const MeshDescription& mesh, const PatchNumbering& numbering, const CutResult& cut,
                          int parts, RefineMode refine, const std::vector<int>& given);

}  // namespace coseg
