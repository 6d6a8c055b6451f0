#pragma once
// Brings meshes of extreme size into the range in which squares of areas are doubles.

#include "src/mesh/polygon_mesh.hpp"

namespace coseg {

/// The power of two of the largest coordinate, if that is beyond 1e60 or below 1e-60, so that squares of the
/// areas of faces, of which norms are made, may leave the range of doubles; else 0.
int extreme_exponent(const PolygonMesh& mesh);

/// The mesh times 2^exponent, which loses no digit.
PolygonMesh scaled_by_power(PolygonMesh mesh, int exponent);

}  // namespace coseg
