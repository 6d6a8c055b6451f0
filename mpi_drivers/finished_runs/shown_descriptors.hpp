#pragma once
// Computes the descriptors of a finished run's shapes again, as one number per face of the file, for pictures
// and exports.

#include <Eigen/Core>
#include <vector>

#include "io/folders/finished_run.hpp"
#include "mpi_drivers/finished_runs/finished_shapes.hpp"
#include "src/descriptors/descriptor_table.hpp"
#include "src/mesh/face_map.hpp"

namespace coseg {

/// One number per face of the file: the mean of `values`, one a working face, over the pieces into which the
/// face was cut, weighted by their areas. A face without a piece takes the value of its label donor, as it
/// takes its label.
std::vector<double> per_input_face(const FaceMap& map, const Eigen::VectorXd& values,
                                   const Eigen::VectorXd& areas);

/// For each of the rows `chosen` of descriptor_table() (ascending) one number per face of the file: the mean
/// of shown_values() over the pieces into which the face was cut, weighted by area. The values are those
/// before any rescaling, in the unit in which the shape has area 1. They are computed with the run's seed and
/// sizes, and are therefore the same as in the run. Serial. Throws Error(input).
std::vector<std::vector<double>> shown_descriptors(const FinishedRun& run, const LabelledMesh& shape,
                                                   const std::vector<int>& chosen);

}  // namespace coseg
