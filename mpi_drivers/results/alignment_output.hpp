#pragma once
// Writes alignment.json: how each shape of a run is turned, scaled and moved so that all stand alike.

#include <string>

#include "mpi_drivers/describe/mesh_stage.hpp"
#include "src/parallel/comm.hpp"
#include "src/records/shape_alignment.hpp"

namespace coseg {

/// Writes FOLDER/alignment.json (io/data_files/alignment_file.hpp), in the units of the files. Where shapes
/// are not aligned, every one has the identity for a rotation, and a scale and a translation that bring its
/// centre to the origin and its size to that of the others. Collective; throws AgreedError(output).
void write_alignment_file(const Comm& comm, const std::string& folder, const Collection& collection,
                          const ShapeAlignment& alignment);

}  // namespace coseg
