#include "io/mesh_files/mesh_format.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <iterator>

#include "io/gltf/gltf_container.hpp"
#include "io/mesh_files/gltf_format.hpp"
#include "io/mesh_files/obj_format.hpp"
#include "io/mesh_files/off_format.hpp"
#include "io/mesh_files/ply_format.hpp"
#include "io/mesh_files/stl_format.hpp"
#include "io/mesh_files/vtk_reader.hpp"
#include "io/mesh_files/vtk_writer.hpp"
#include "src/base/error.hpp"

namespace coseg {

namespace {

constexpr std::array<MeshFormat, 7> formats{{
    {.name = "OFF", .suffix = ".off", .read = read_off, .write = write_labelled_off},
    {.name = "OBJ",
     .suffix = ".obj",
     .read = read_obj,
     .write = write_obj,
     .write_shared = write_obj_materials},
    {.name = "PLY", .suffix = ".ply", .read = read_ply, .write = write_ply},
    {.name = "STL", .suffix = ".stl", .read = read_stl, .write = write_stl},
    {.name = "GLB",
     .suffix = ".glb",
     .read = read_gltf,
     .write = write_glb,
     .gather = with_buffer_files,
     .write_like = write_glb_like},
    {.name = "glTF", .suffix = ".gltf", .read = read_gltf, .gather = with_buffer_files},
    {.name = "VTP",
     .suffix = ".vtp",
     .read = read_vtp,
     .write = write_vtp,
     .export_name = "vtk",
     .keeps_values = true,
     .write_collection = write_vtm,
     .collection_suffix = ".vtm"},
}};

std::string in_lower_case(std::string_view text) {
    std::string lower(text);
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return lower;
}

std::string export_name(const MeshFormat& format) {
    return format.export_name.empty() ? in_lower_case(format.name) : std::string(format.export_name);
}

std::vector<MeshFormat> readable() {
    std::vector<MeshFormat> rows;
    std::copy_if(formats.begin(), formats.end(), std::back_inserter(rows),
                 [](const MeshFormat& format) { return format.read != nullptr; });
    return rows;
}

}  // namespace

std::span<const MeshFormat> mesh_formats() { return formats; }

std::string suffix_of(const std::string& path) {
    return in_lower_case(std::filesystem::path(path).extension().string());
}

const MeshFormat* readable_format_of(const std::string& path) {
    const std::string suffix = suffix_of(path);
    const auto* const found = std::find_if(formats.begin(), formats.end(), [&](const MeshFormat& format) {
        return format.suffix == suffix && format.read != nullptr;
    });
    return found == formats.end() ? nullptr : found;
}

std::vector<std::string> writable_formats() {
    std::vector<std::string> names;
    for (const MeshFormat& format : formats) {
        if (format.write != nullptr) names.push_back(export_name(format));
    }
    return names;
}

const MeshFormat& writable_format(const std::string& name) {
    for (const MeshFormat& format : formats) {
        if (format.write != nullptr && export_name(format) == name) return format;
    }
    throw Error(ExitCode::internal, "no mesh format '" + name + "' is written");
}

std::string readable_formats() {
    std::string names;
    for (const MeshFormat& format : readable()) names.append(names.empty() ? "" : ", ").append(format.name);
    return names;
}

std::string readable_suffixes(std::string_view word) {
    const std::vector<MeshFormat> rows = readable();
    std::string suffixes;
    for (std::size_t k = 0; k < rows.size(); ++k) {
        if (k > 0 && k + 1 < rows.size()) suffixes += ", ";
        if (k > 0 && k + 1 == rows.size()) suffixes.append(" ").append(word).append(" ");
        suffixes += rows[k].suffix;
    }
    return suffixes;
}

}  // namespace coseg
