#pragma once
// Finds meshes whose coordinates had not enough digits.

#include <optional>
#include <string>

#include "src/mesh/polygon_mesh.hpp"

namespace coseg {

/// A sentence, without the path, about a mesh whose coordinates are kept in single precision and that lies
/// so far from the origin that the steps between such numbers are more than a hundredth of the average
/// length of its edges, as with map coordinates: the shape is then that of the steps. The same of a mesh so
/// small that single precision has no numbers for it. Nothing for other meshes.
std::optional<std::string> lost_digits(const PolygonMesh& mesh);

}  // namespace coseg
