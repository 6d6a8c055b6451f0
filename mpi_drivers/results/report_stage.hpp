#pragma once
// Makes report.html from a folder of results.

#include <string>

#include "mpi_drivers/finished_runs/finished_shapes.hpp"
#include "mpi_drivers/finished_runs/sheet_stage.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

/// Writes OUT/report.html of the results in input.folder, with accuracies if input.truth is given. Meshes of
/// many faces are shown coarser, so that the file stays small: report_face_budget triangles in all, or
/// report_least_faces for a shape. Of more than report_most_shapes shapes every second, third ... can be
/// turned, and all are in the table. Every rank reads and packs its share of the shapes. Collective; throws
/// AgreedError.
inline constexpr int report_face_budget = 800000;
inline constexpr int report_least_faces = 500;
inline constexpr int report_most_shapes = 2000;
void write_html_report(const Comm& comm, const FinishedInput& input, const std::string& out,
                       const ViewChoice& choice);

}  // namespace coseg
