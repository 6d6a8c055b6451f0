#pragma once
// Writes labelled meshes for ParaView, as VTK's XML files.

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "io/mesh_files/face_arrays.hpp"
#include "src/mesh/polygon_mesh.hpp"

namespace coseg {

/// Writes the polygons as PolyData (.vtp), vertices in single precision, arrays little endian behind the XML
/// and values in single precision. The first of arrays.labels is what ParaView colours by. Written whole or
/// not at all; Error(output) as atomic_file.hpp, Error(internal) if an array has not one value per face.
/// Source: VTK File Formats, XML formats (version 1.0, appended raw data, UInt64 headers).
void write_vtp(const std::string& path, const PolygonMesh& mesh, const FaceArrays& arrays);

/// Writes a multi-block file (.vtm) that opens `files` (name, path relative to the .vtm) at once.
void write_vtm(const std::string& path, const std::vector<std::pair<std::string, std::string>>& files);

}  // namespace coseg
