#pragma once
// Draws the contact sheet that a run leaves beside its labels.

#include <string>

#include "mpi_drivers/results/output_stage.hpp"
#include "src/parallel/comm.hpp"
#include "src/pictures/shape_view.hpp"

namespace coseg {

/// contact_sheet.png (src/pictures/contact_sheet.hpp) in the folder: every shape, coloured by part, and
/// turned as the run aligned it. Each rank draws the meshes that it holds. The same bytes on any number of
/// ranks. Collective; throws AgreedError.
void write_run_sheet(const Comm& comm, const std::string& folder, const RunOutcome& outcome,
                     const ViewChoice& choice);

}  // namespace coseg
