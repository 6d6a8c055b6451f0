#pragma once
// Leaves out of a GLB file what its scene does not draw.

#include <string>
#include <string_view>

namespace coseg {

/// The file again, with what its scene needs and nothing else: nodes of the scene, their meshes and skins
/// with the joints, materials, textures, images, and of each attribute the vertices that the indices name.
/// Elements keep their bytes. Attributes that cannot be taken apart (matrices, or accessors without bytes of
/// their own) stay whole.
///
/// Animations stay where a skin does. Cameras, other scenes and extensions beyond those of materials,
/// textures and lights are left out, as they may refer to what is no longer there; members that no
/// specification names stay. `glb` is what glb_of_parts makes: one scene, and one buffer. `path` is that of
/// the file to be written, for sentences. Throws Error(input) as the reader, Error(output) as glb_of.
std::string compact_glb(std::string_view glb, const std::string& path);

}  // namespace coseg
