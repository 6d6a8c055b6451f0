#pragma once
// The curves along which two parts of a shape meet.

#include <vector>

#include "src/mesh/tri_mesh.hpp"

namespace coseg {

/// A line of mesh edges with the faces of part_a on its left side, seen from outside, and those of part_b on
/// its right.
struct BorderCurve {
    int part_a = 0;  ///< part_a < part_b
    int part_b = 0;
    bool is_closed = false;     ///< then the first vertex follows the last one again
    std::vector<int> vertices;  ///< of the mesh, in order
    double length = 0.0;        ///< in the mesh's unit
};

/// All curves, sorted by part_a, part_b, then their first vertex. Every edge whose two faces are of different
/// parts is in exactly one. A curve ends where it meets another one of its two parts, and where three parts
/// meet. A closed curve begins at its lowest vertex. part_of_face: F numbers of at least 0.
std::vector<BorderCurve> part_borders(const TriMesh& mesh, const std::vector<int>& part_of_face);

}  // namespace coseg
