#pragma once
// Reads glTF 2.0 files, binary (.glb) and text (.gltf), and writes labelled meshes as GLB with a node a part.

#include <string>
#include <string_view>

#include "io/mesh_files/face_arrays.hpp"
#include "io/mesh_files/parsed_mesh.hpp"
#include "src/mesh/polygon_mesh.hpp"

namespace coseg {

/// Reads the triangles of the scene, each node in its place: the scene that the file names as its own, else
/// the first. Faces are in the order nodes (depth first, children in the file's order), primitives,
/// triangles. Corners at equal positions become one vertex, so that the seams of texture and normals, and
/// those between primitives, are closed; vertices are numbered in the order in which faces name them. A node
/// that mirrors turns its faces. Points and lines are passed over with a warning, skins and morph targets
/// without one. The bytes are those of mesh_file_bytes, which hold what a .gltf file keeps in files beside
/// it. mesh_format.hpp says what all readers have in common.
ParsedMesh read_gltf(std::string_view bytes, const std::string& path);

/// Writes triangles in single precision without normals: one node, mesh and material a part, in the order of
/// parts; with an array "piece" beside the parts, one node a piece below the node of its part. Faces of
/// a part below 0 are left out. Polygons are cut into triangles, and faces of fewer than three corners are
/// left out. Where lost_digits.hpp asks for it, vertices are kept relative to the middle of the shape, which
/// the nodes add; those of a shape too small for single precision are divided by its size, which the nodes
/// give back. Names are those of arrays.part_names. Error(output) as atomic_file.hpp, Error(internal) as
/// parts_of.
void write_glb(const std::string& path, const PolygonMesh& mesh, const FaceArrays& arrays);

/// Writes the glTF file of these bytes again with its triangles shared out among nodes as above
/// (gltf_parts.hpp says what stays as it is). Throws as write_glb, and Error(input) as read_gltf.
void write_glb_like(const std::string& path, const MeshSource& source, const FaceArrays& arrays);

}  // namespace coseg
