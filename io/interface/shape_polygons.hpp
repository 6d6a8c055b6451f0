#pragma once
// The meshes of the shapes that a caller of the interface gives: files, or arrays in the caller's memory.

#include <coseg/shapes.hpp>
#include <cstddef>
#include <string>

#include "io/mesh_files/parsed_mesh.hpp"

namespace coseg {

/// What messages call a shape that is given as arrays: its index, and its name where it has one.
std::string called(const Shape& shape, std::size_t index);

/// The polygons of one shape, with what its reader warns of. `index` is for messages. Throws Error(input).
ParsedMesh polygons_of(const Shape& shape, std::size_t index);

}  // namespace coseg
