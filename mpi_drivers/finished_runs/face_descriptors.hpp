#pragma once
// The descriptors of a finished run's shapes, computed again, one value per face of the file: for pictures and exports.

#include <array>
#include <string>
#include <vector>

#include "io/folders/finished_run.hpp"
#include "mpi_drivers/describe/mesh_description.hpp"
#include "mpi_drivers/finished_runs/finished_shapes.hpp"

namespace coseg {

/// In the order of feature_names; F values each, the mean over the pieces that a face was cut into, weighted by area.
/// The shape context, a histogram, is told by the mean ring of its area: 0 where all of the shape is near, 4 where all of it
/// is far. In the unit in which the shape has area 1.
using FaceDescriptors = std::array<std::vector<double>, feature_total>;

/// With the run's seed and sizes, so the same values as in the run. Serial. Throws Error(input).
FaceDescriptors face_descriptors(const FinishedRun& run, const LabelledMesh& shape);

}  // namespace coseg
