#pragma once
// Reads the polygons of VTK's XML files; vtk_writer.hpp writes them.

#include <string>
#include <string_view>

#include "io/mesh_files/parsed_mesh.hpp"

namespace coseg {

/// Reads PolyData (.vtp) as VTK and ParaView write it: arrays as text, in base64, or behind the XML as bytes
/// or base64, of either byte order, with lengths of 32 or 64 bits, uncompressed or compressed by zlib. The
/// faces of a piece are its polygons and then the triangles of its strips, of which those that repeat a
/// corner only lead the strip on; pieces follow one another. Other arrays are passed over, and so are points
/// and lines, with a warning. Coordinates that have lost digits are warned of (lost_digits.hpp).
/// mesh_format.hpp says what all readers have in common.
/// Source: VTK File Formats, XML formats.
ParsedMesh read_vtp(std::string_view bytes, const std::string& path);

}  // namespace coseg
