#pragma once
// Says what a file is that is not the mesh its suffix promises.

#include <optional>
#include <string>
#include <string_view>

namespace coseg {

/// What the bytes are, with what to do about it: "a Git LFS pointer, not the mesh itself; fetch the mesh
/// with 'git lfs pull'", "a web page ...", "a ZIP archive ...", "an OFF file ...". It goes by how such
/// files begin. `format` is the name of the format in which the bytes could not be read, as in
/// mesh_format.hpp. Nothing if the bytes begin like a file of that format, or like nothing that is known.
std::optional<std::string> foreign_content(std::string_view bytes, std::string_view format);

}  // namespace coseg
