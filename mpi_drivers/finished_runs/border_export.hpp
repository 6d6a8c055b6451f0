#pragma once
// Exports the borders between the parts of a finished run, and the measures of the parts.

#include <string>
#include <vector>

#include "mpi_drivers/finished_runs/finished_shapes.hpp"

namespace coseg {

struct BorderExport {
    const FinishedRun& run;
    const std::vector<LabelledMesh>& shapes;  ///< of this rank
    const std::vector<std::string>& part_names;
    std::vector<int> descriptors;  ///< rows of descriptor_table() whose means are written too
    std::string folder;            ///< exists
};

/// Writes FOLDER/NAME.obj and NAME.vtp, the curves between the parts of each shape, and FOLDER/parts.csv and
/// parts.json, the measures of all parts, in the units of the files. The same bytes on any number of ranks.
/// Collective; throws AgreedError(input) or AgreedError(output).
void export_borders(const Comm& comm, const BorderExport& task);

}  // namespace coseg
