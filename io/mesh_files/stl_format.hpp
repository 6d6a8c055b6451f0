#pragma once
// Reads STL files.

#include <string>
#include <string_view>

#include "src/mesh/polygon_mesh.hpp"

namespace coseg {

/// Reads ASCII and binary STL. Corners at equal positions become one vertex. Vertices are numbered in the
/// order in which the facets name them; those that only facets with two equal corners name come last.
/// Coordinates are in single precision, in ASCII files too. mesh_format.hpp says what all readers have in
/// common.
PolygonMesh read_stl(std::string_view bytes, const std::string& path);

}  // namespace coseg
