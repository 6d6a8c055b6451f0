#pragma once
// Writes labelled meshes as coloured PLY files for mesh viewers.

#include <string>
#include <vector>

#include "src/mesh/polygon_mesh.hpp"

namespace coseg {

/// Writes the polygons as binary little-endian PLY: vertices as float (viewers expect it), faces in their
/// order with the colour of their part (part_colors.hpp) as uchar red, green, blue. labels has one entry per
/// face. Written whole or not at all; Error(output) as in atomic_file.hpp, Error(internal) if the counts
/// differ.
void write_colored_ply(const std::string& path, const PolygonMesh& mesh, const std::vector<int>& labels);

}  // namespace coseg
