#pragma once
// What a glTF file describes of its geometry, as plain records: nothing of it refers to JSON any more.
// Source: Khronos Group, glTF 2.0 Specification, chapters 3 and 5.

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/gltf/gltf_container.hpp"

namespace coseg {

struct GltfView {
    int buffer = 0;
    std::size_t offset = 0;  ///< in the buffer; offset + length lies within it
    std::size_t length = 0;
    std::size_t stride = 0;  ///< bytes from an element to the next; 0 if they follow each other
};

/// What replaces some elements of an accessor.
struct GltfSparse {
    std::size_t count = 0;
    int index_view = 0;
    std::size_t index_offset = 0;
    int index_type = 0;
    int value_view = 0;
    std::size_t value_offset = 0;
};

struct GltfAccessor {
    int view = -1;  ///< -1 if there is none
    std::size_t offset = 0;
    int component_type = 0;  ///< 5120 to 5126, one of those that component_size knows
    bool is_normalized = false;
    std::size_t count = 0;
    int components = 0;  ///< 1 for SCALAR, 3 for VEC3; 0 for matrices
    std::optional<GltfSparse> sparse;
};

enum class GltfMode { points, lines, line_loop, line_strip, triangles, triangle_strip, triangle_fan };

struct GltfPrimitive {
    GltfMode mode = GltfMode::triangles;
    int positions = -1;  ///< accessors; -1 if there is none
    int indices = -1;
    std::string compression;  ///< the extension with which its data are compressed; empty if they are not
};

struct GltfNode {
    int mesh = -1;  ///< -1 if there is none
    int skin = -1;
    std::vector<int> children;
    Eigen::Matrix4d to_parent = Eigen::Matrix4d::Identity();
};

/// All numbers of views, accessors, meshes, skins and nodes in it are numbers of what is there. Buffers point
/// into the bytes of the file or into `decoded`.
struct GltfAsset {
    std::string path;  ///< of the file, for sentences
    std::vector<std::string_view> buffers;
    std::vector<std::vector<char>> decoded;  ///< buffers that stand in the JSON in base64
    std::vector<GltfView> views;
    std::vector<GltfAccessor> accessors;
    std::vector<std::vector<GltfPrimitive>> meshes;
    std::vector<GltfNode> nodes;
    int scene = -1;  ///< the scene that is read: the one the file names, else the first; -1 if there is none
    std::vector<int> roots;  ///< of the scene; without scenes, the nodes that are no other's child
};

/// The bytes of a component of an accessor's type 5120 (int8) to 5126 (float); 0 for another type.
std::size_t component_size(int component_type);

/// Throws Error(input), one sentence that begins with "PATH: " and names the place in the JSON, for what is
/// no glTF 2.0, refers to what is not there, leads out of a buffer, or needs an extension that is not known.
GltfAsset read_gltf_asset(const GltfContainer& container, const std::string& path);

}  // namespace coseg
