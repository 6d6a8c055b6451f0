#pragma once
// Writes labelled meshes as OBJ with one material per part.

#include <string>
#include <vector>

#include "src/mesh/polygon_mesh.hpp"

namespace coseg {

/// Writes `parts` materials part_0, part_1, ... in the colours of part_colors.hpp. Error(output) as
/// atomic_file.hpp.
void write_part_materials(const std::string& path, int parts);

/// Writes vertices in their order with 9 digits, and the faces of each part, in their order, under its
/// material. material_file: as the OBJ names it. Error(output) as there, Error(internal) if labels are not
/// one a face.
void write_part_obj(const std::string& path, const std::string& material_file, const PolygonMesh& mesh,
                    const std::vector<int>& labels);

}  // namespace coseg
