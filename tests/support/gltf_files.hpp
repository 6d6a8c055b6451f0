#pragma once
// A small glTF file whose JSON a test may change.

#include <cstdint>
#include <string>
#include <vector>

#include "io/files/byte_cursor.hpp"
#include "io/gltf/gltf_container.hpp"

namespace coseg::test {

template <class T>
std::string little_endian(const std::vector<T>& values) {
    std::string bytes;
    for (const T value : values) append_little_endian(bytes, value);
    return bytes;
}

/// Replaces `from`, which must be there, by `to`.
inline std::string with(std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
}

/// A tetrahedron of 4 vertices and 12 indices of two bytes in one buffer of 72 bytes, at one node.
inline const std::string tetrahedron_json =
    R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)"
    R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],)"
    R"("accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},)"
    R"({"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}],)"
    R"("bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":24}],)"
    R"("buffers":[{"byteLength":72}]})";

inline std::string tetrahedron_bytes() {
    return little_endian<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}) +
           little_endian<std::uint16_t>({0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3});
}

inline std::string tetrahedron_glb(const std::string& json = tetrahedron_json) {
    return glb_of(json, tetrahedron_bytes(), "test.glb");
}

}  // namespace coseg::test
