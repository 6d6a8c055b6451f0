#pragma once
// How each shape of a run is turned, scaled and moved so that all stand alike, in the units of the files.

#include <string>

#include "io/data_files/alignment_file.hpp"
#include "mpi_drivers/describe/mesh_stage.hpp"
#include "src/parallel/comm.hpp"
#include "src/records/shape_alignment.hpp"

namespace coseg {

/// The alignment in the units of the files, shapes in the order of the collection, on all ranks. Where shapes
/// are not aligned, every one has the identity for a rotation, and a scale and a translation that bring its
/// centre to the origin and its size to that of the others. Collective.
AlignmentFile alignment_in_file_units(const Comm& comm, const Collection& collection,
                                      const ShapeAlignment& alignment);

/// Writes it to FOLDER/alignment.json. Collective; throws AgreedError(output).
void write_alignment_file(const Comm& comm, const std::string& folder, const Collection& collection,
                          const ShapeAlignment& alignment);

}  // namespace coseg
