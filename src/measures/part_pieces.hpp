#pragma once
// Splits the parts of a shape into their connected pieces.

#include <vector>

#include "src/mesh/tri_mesh.hpp"

namespace coseg {

/// The number of the piece of each face. Two faces are in the same piece if they are of the same part and a
/// path of shared edges inside the part joins them. Pieces are numbered from 0 in the order of their lowest
/// face. part_of_face: F numbers.
std::vector<int> part_pieces(const TriMesh& mesh, const std::vector<int>& part_of_face);

}  // namespace coseg
