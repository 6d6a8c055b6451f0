#pragma once
// The two forms of a glTF file: text in JSON (.gltf), and the binary container of chunks (.glb).
// Source: Khronos Group, glTF 2.0 Specification, chapter 4 (GLB).

#include <string>
#include <string_view>
#include <vector>

namespace coseg {

/// The pieces of a file. They point into its bytes.
struct GltfContainer {
    std::string_view json;
    std::string_view binary;  ///< the BIN chunk, which is buffer 0 where that names no file
    bool has_binary = false;
    /// The files that buffers name, in the order of these buffers: only after with_buffer_files.
    std::vector<std::string_view> buffer_files;
    std::vector<std::string> warnings;  ///< one sentence each, beginning with the path
};

/// Whether the bytes begin as a binary container does.
bool is_glb(std::string_view bytes);

/// Splits a file of either form. Throws Error(input), a sentence that begins with "PATH: ", for a container
/// that is cut short, of another version, or without JSON in its first chunk.
GltfContainer split_gltf(std::string_view bytes, const std::string& path);

/// Throws Error(input) if brackets nest so deep in the JSON that walking down could exhaust the stack.
void check_json_depth(std::string_view json, const std::string& path);

/// The bytes of the file at `path` together with those of the files that its buffers name: a container with
/// a chunk of our own for each such file. The same bytes if there is none, or if they are no glTF; but JSON
/// is in UTF-8 without a byte order mark afterwards, whatever it was before. Throws Error(input) if such a
/// file is not there, or does not lie beside the mesh or below its folder.
std::string with_buffer_files(std::string bytes, const std::string& path);

/// The bytes of the file that `uri` names, relative to the folder of `path`. Throws as with_buffer_files.
std::string file_of_uri(const std::string& uri, const std::string& path);

/// A container of these two. Throws Error(output) naming `path`, the file to be written, if it would be
/// larger than the 4 GiB that the format can hold.
std::string glb_of(std::string_view json, std::string_view binary, const std::string& path);

}  // namespace coseg
