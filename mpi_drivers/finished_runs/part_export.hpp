#pragma once
// Writes the shapes of a finished run in a mesh format: whole, or every part in a file of its own.

#include <string>
#include <vector>

#include "io/mesh_files/mesh_format.hpp"
#include "mpi_drivers/finished_runs/finished_shapes.hpp"

namespace coseg {

/// Writes a shape whole at `path`. Where the mesh was read from a file of the same kind, which holds more
/// than the format writes by itself, it is that file with parts. Serial; throws Error.
void write_whole(const MeshFormat& format, const std::string& path, const LabelledMesh& shape,
                 const FaceArrays& arrays);

/// Writes every part of a shape, or every piece if `arrays` has an array "piece", as a file of its own into
/// FOLDER, which is made: part_NUMBER_NAME.SUFFIX, part_NUMBER_NAME_PIECE.SUFFIX. `parts` of the run. Serial;
/// throws Error.
void write_split(const MeshFormat& format, const std::string& folder, const LabelledMesh& shape,
                 const FaceArrays& arrays, int parts);

}  // namespace coseg
