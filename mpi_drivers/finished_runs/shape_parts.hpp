#pragma once
// The parts of a finished run's shapes as surfaces: names, clean triangles, connected pieces.

#include <string>
#include <vector>

#include "mpi_drivers/finished_runs/finished_shapes.hpp"
#include "src/mesh/face_map.hpp"
#include "src/mesh/tri_mesh.hpp"

namespace coseg {

/// A shape's triangles after the repair, with their parts.
struct PartSurface {
    TriMesh mesh;
    FaceMap map;            ///< triangles -> faces of the file
    std::vector<int> part;  ///< per triangle
};

/// Serial; throws Error(input) as repair does.
PartSurface part_surface(const LabelledMesh& shape);

/// The name of every part of the run. They are read from `file` if it is not empty, else from names.txt in
/// the folder of the run, else from labels.txt beside the true labels (input.truth), where each part is
/// called like the label for which it stands. A part without a name is called part_NUMBER. Collective; throws
/// AgreedError(input).
std::vector<std::string> names_of_parts(const Comm& comm, const FinishedRun& run,
                                        const std::vector<LabelledMesh>& shapes, const FinishedInput& input,
                                        const std::string& file);

/// For each shape of this rank, per face of its file: the number of its connected piece in its part, from 1,
/// which agrees over the collection as piece_numbers.hpp says, where the shapes stand as the run aligned
/// them. Collective; throws AgreedError(input).
std::vector<std::vector<int>> instances_of(const Comm& comm, const std::vector<LabelledMesh>& shapes);

}  // namespace coseg
