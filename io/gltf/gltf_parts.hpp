#pragma once
// Writes parts of a shape as nodes of a GLB file.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace coseg {

/// An object of the file: a part, or a connected piece of one.
struct GltfObject {
    std::string name;
    int part = 0;
    int piece = -1;  ///< its number in the part; -1 if the object is the whole part
};

/// Which faces belong to which object. Objects are sorted by part, then piece.
struct GltfObjects {
    std::vector<GltfObject> objects;
    std::vector<std::string> part_names;  ///< by part: of materials, and of the nodes above pieces
    std::vector<int> object_of_face;      ///< -1 for a face that is left out
};

/// Plain triangles.
struct GltfSurface {
    std::vector<Eigen::Vector3f> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< of the vertices in the scene
    double scale = 1.0;                                ///< length in the scene of a unit of the vertices
};

/// A GLB file of the triangles: one node, mesh and material an object; extras `part` and `piece` at the
/// nodes. Objects without faces have no node. `path` is that of the file to be written, for sentences.
std::string glb_of_surface(const GltfSurface& surface, const GltfObjects& objects, const std::string& path);

/// The glTF file `bytes` (from mesh_file_bytes, read at `source`) again as GLB, its triangles shared out
/// among objects:
/// - Every object is one node at the top of the scene; where its triangles lie at nodes that stand in
///   different places, it has a child for each place, in the order in which the file comes to them.
/// - Attributes, materials, textures, images, animations, cameras, extensions and extras stay as they are,
///   and the bytes of all buffers too; only indices are new. Files of images become part of the buffer,
///   unless they cannot be read.
/// - The nodes of the file lose the triangles and nothing else. Their animations no longer move the parts,
///   but skins do.
/// - The extension KHR_materials_variants has a variant "parts", in which each part has its colour.
/// Where objects leave faces out, the file has nothing but what the others need (gltf_compaction.hpp), and
/// of the nodes that were there only those that move a skin.
/// `objects` has an entry for each face of read_gltf. Throws Error(input) as the reader, Error(internal) for
/// another number of faces, Error(output) as glb_of.
std::string glb_of_parts(std::string_view bytes, const std::string& source, const GltfObjects& objects,
                         const std::string& path);

}  // namespace coseg
