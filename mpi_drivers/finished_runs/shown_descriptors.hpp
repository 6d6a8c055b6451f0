#pragma once
// The descriptors of a finished run's shapes, computed again, one number per face of the file: for pictures
// and exports.

#include <vector>

#include "io/folders/finished_run.hpp"
#include "mpi_drivers/finished_runs/finished_shapes.hpp"
#include "src/descriptors/descriptor_table.hpp"

namespace coseg {

/// For each of the rows `chosen` of descriptor_table() (ascending) one number per face of the file: the mean
/// over the pieces that the face was cut into, weighted by area, of shown_values(). Before any rescaling, in
/// the unit in which the shape has area 1. With the run's seed and sizes, so the same values as in the run.
/// Serial. Throws Error(input).
std::vector<std::vector<double>> shown_descriptors(const FinishedRun& run, const LabelledMesh& shape,
                                                   const std::vector<int>& chosen);

}  // namespace coseg
