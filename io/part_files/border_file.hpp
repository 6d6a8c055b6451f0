#pragma once
// Writes the curves between parts as lines that modelling programs read.

#include <string>
#include <vector>

#include "src/measures/part_borders.hpp"
#include "src/mesh/tri_mesh.hpp"

namespace coseg {

/// Writes an OBJ file of lines: the vertices of all curves, each once and with all its digits, then for each
/// pair of parts an object "NAME_A | NAME_B" and one line "l" a curve, which names its first vertex again at
/// its end if it is closed. part_names: by part. Error(output) as atomic_file.hpp.
void write_border_lines(const std::string& path, const TriMesh& mesh, const std::vector<BorderCurve>& curves,
                        const std::vector<std::string>& part_names);

/// Writes the same curves as VTK poly lines, in an ASCII .vtp file with the arrays "part_a", "part_b" and
/// "closed" of the lines. A closed curve names its first vertex again. Error(output) as atomic_file.hpp.
void write_border_vtp(const std::string& path, const TriMesh& mesh, const std::vector<BorderCurve>& curves);

}  // namespace coseg
