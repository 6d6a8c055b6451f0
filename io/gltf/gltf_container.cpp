#include "io/gltf/gltf_container.hpp"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "io/files/byte_cursor.hpp"
#include "io/files/file_contents.hpp"
#include "io/files/text_cursor.hpp"
#include "io/files/text_encoding.hpp"
#include "src/base/error.hpp"
#include "src/base/text.hpp"

namespace coseg {

namespace {

constexpr std::string_view glb_magic = "glTF";
constexpr std::size_t header_size = 12;
constexpr std::size_t chunk_header_size = 8;
constexpr std::uint32_t json_chunk = 0x4E4F534A;    // "JSON"
constexpr std::uint32_t binary_chunk = 0x004E4942;  // "BIN"
/// "cseg": other readers pass over chunks that they do not know.
constexpr std::uint32_t file_chunk = 0x67657363;

[[noreturn]] void refuse_container(const std::string& path, const std::string& what) {
    throw Error(ExitCode::input, path + ": " + what);
}

/// The length that the header promises, checked.
std::size_t promised_length(std::string_view bytes, const std::string& path) {
    std::uint32_t version = 0;
    std::uint32_t length = 0;
    ByteCursor cursor(bytes, glb_magic.size(), false);
    if (!cursor.read(version) || !cursor.read(length))
        refuse_container(path, "the file ends inside its header; export the mesh again");
    if (version != 2) {
        refuse_container(path, "is glTF of version " + std::to_string(version) +
                                   ", but only version 2 is read; export the mesh as glTF 2.0");
    }
    if (length > bytes.size()) {
        refuse_container(path, "the file has " + std::to_string(bytes.size()) + " of the " +
                                   std::to_string(length) +
                                   " bytes that its header promises; export the mesh again");
    }
    return length;
}

struct GlbChunk {
    std::uint32_t type = 0;
    std::string_view bytes;
};

std::vector<GlbChunk> chunks_of(std::string_view bytes, const std::string& path) {
    std::vector<GlbChunk> chunks;
    std::size_t place = header_size;
    while (place + chunk_header_size <= bytes.size()) {
        ByteCursor cursor(bytes, place, false);
        std::uint32_t length = 0;
        std::uint32_t type = 0;
        cursor.read(length);
        cursor.read(type);
        if (length > cursor.left()) {
            refuse_container(path, "chunk " + std::to_string(chunks.size()) + " should have " +
                                       std::to_string(length) + " bytes, but the file has only " +
                                       std::to_string(cursor.left()) + " left; export the mesh again");
        }
        chunks.push_back({type, bytes.substr(place + chunk_header_size, length)});
        place += chunk_header_size + length;
    }
    return chunks;
}

GltfContainer split_glb(std::string_view bytes, const std::string& path) {
    const std::size_t length = promised_length(bytes, path);
    const std::vector<GlbChunk> chunks = chunks_of(bytes.substr(0, length), path);
    if (chunks.empty() || chunks.front().type != json_chunk)
        refuse_container(path, "the first chunk of the file is not its JSON; export the mesh again");
    GltfContainer container;
    container.json = chunks.front().bytes;
    for (const GlbChunk& chunk : chunks) {
        if (chunk.type == file_chunk) container.buffer_files.push_back(chunk.bytes);
        if (chunk.type != binary_chunk || container.has_binary) continue;
        container.binary = chunk.bytes;
        container.has_binary = true;
    }
    if (length < bytes.size()) {
        container.warnings.push_back(
            path + ": " + with_unit(static_cast<std::int64_t>(bytes.size() - length), "byte", "bytes") +
            " behind the end that the header gives are left out");
    }
    return container;
}

void append_chunk(std::string& bytes, std::uint32_t type, std::string_view content, char padding) {
    const std::size_t gap = (4 - content.size() % 4) % 4;
    append_little_endian(bytes, static_cast<std::uint32_t>(content.size() + gap));
    append_little_endian(bytes, type);
    bytes.append(content);
    bytes.append(gap, padding);
}

/// A header whose length is set by finish_glb.
std::string begun_glb() {
    std::string bytes(glb_magic);
    append_little_endian(bytes, std::uint32_t{2});
    append_little_endian(bytes, std::uint32_t{0});
    return bytes;
}

bool finish_glb(std::string& bytes) {
    if (bytes.size() > std::numeric_limits<std::uint32_t>::max()) return false;
    std::string length;
    append_little_endian(length, static_cast<std::uint32_t>(bytes.size()));
    bytes.replace(glb_magic.size() + sizeof(std::uint32_t), length.size(), length);
    return true;
}

/// The percent signs of a URI decoded: "my%20mesh.bin".
std::string decoded_uri(const std::string& uri) {
    std::string text;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        const std::string byte =
            uri[i] == '%' && i + 2 < uri.size() ? bytes_of_hex(uri.substr(i + 1, 2)) : "";
        if (byte.size() == 1) {
            text += byte;
            i += 2;
        } else {
            text += uri[i];
        }
    }
    return text;
}

/// The names of the files in which buffers lie; nothing where the JSON is none.
std::vector<std::string> buffer_uris(std::string_view json) {
    std::vector<std::string> uris;
    const nlohmann::json document = nlohmann::json::parse(json, nullptr, false);
    if (!document.is_object() || !document.contains("buffers") || !document["buffers"].is_array())
        return uris;
    for (const nlohmann::json& buffer : document["buffers"]) {
        if (!buffer.is_object() || !buffer.contains("uri") || !buffer["uri"].is_string()) continue;
        const std::string uri = buffer["uri"].get<std::string>();
        if (!uri.starts_with("data:")) uris.push_back(uri);
    }
    return uris;
}

}  // namespace

bool is_glb(std::string_view bytes) { return bytes.starts_with(glb_magic); }

GltfContainer split_gltf(std::string_view bytes, const std::string& path) {
    if (is_glb(bytes)) return split_glb(bytes, path);
    GltfContainer container;
    container.json = bytes;
    return container;
}

void check_json_depth(std::string_view json, const std::string& path) {
    constexpr int deepest = 200;
    int depth = 0;
    bool is_in_text = false;
    for (std::size_t i = 0; i < json.size(); ++i) {
        const char c = json[i];
        if (c == '"') is_in_text = !is_in_text;
        if (is_in_text && c == '\\') ++i;
        if (is_in_text) continue;
        if (c == '[' || c == '{') ++depth;
        if (c == ']' || c == '}') --depth;
        if (depth > deepest)
            refuse_container(path, "the JSON nests more than " + std::to_string(deepest) +
                                       " brackets; export the mesh again");
    }
}

std::string file_of_uri(const std::string& uri, const std::string& path) {
    const std::filesystem::path name(decoded_uri(uri));
    const bool leads_away = name.is_absolute() || uri.find("://") != std::string::npos || name.empty() ||
                            std::find(name.begin(), name.end(), "..") != name.end() ||
                            name.native().find('\0') != std::string::npos;
    if (leads_away) {
        refuse_container(path, "names the file " + in_quotes(uri) +
                                   ", which does not lie beside it; put the file beside it or save as .glb");
    }
    try {
        return read_regular_file((std::filesystem::path(path).parent_path() / name).string());
    } catch (const Error& error) {
        refuse_container(path, "names a file that cannot be read: " + std::string(error.what()));
    }
}

std::string with_buffer_files(std::string bytes, const std::string& path) {
    if (!is_glb(bytes)) bytes = utf8_text(std::move(bytes));
    const GltfContainer container = split_gltf(bytes, path);
    check_json_depth(container.json, path);
    const std::vector<std::string> uris = buffer_uris(container.json);
    if (uris.empty()) return bytes;
    std::string packed = begun_glb();
    append_chunk(packed, json_chunk, container.json, ' ');
    if (container.has_binary) append_chunk(packed, binary_chunk, container.binary, '\0');
    for (const std::string& uri : uris) append_chunk(packed, file_chunk, file_of_uri(uri, path), '\0');
    if (!finish_glb(packed)) refuse_container(path, "has buffers of more than 4 GiB; split the mesh");
    return packed;
}

std::string glb_of(std::string_view json, std::string_view binary, const std::string& path) {
    std::string bytes = begun_glb();
    append_chunk(bytes, json_chunk, json, ' ');
    if (!binary.empty()) append_chunk(bytes, binary_chunk, binary, '\0');
    if (!finish_glb(bytes))
        throw Error(ExitCode::output, path + ": would be larger than the 4 GiB that a GLB file can be");
    return bytes;
}

}  // namespace coseg
