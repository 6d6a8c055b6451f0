#include "io/mesh_files/mesh_format.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>

#include "io/mesh_files/obj_format.hpp"
#include "io/mesh_files/off_format.hpp"
#include "io/mesh_files/ply_format.hpp"
#include "io/mesh_files/stl_format.hpp"

namespace coseg {

namespace {

constexpr std::array<MeshFormat, 4> formats{{
    {"OFF", ".off", read_off},
    {"OBJ", ".obj", read_obj},
    {"PLY", ".ply", read_ply},
    {"STL", ".stl", read_stl},
}};

}  // namespace

std::span<const MeshFormat> mesh_formats() { return formats; }

std::string suffix_of(const std::string& path) {
    std::string suffix = std::filesystem::path(path).extension().string();
    std::transform(suffix.begin(), suffix.end(), suffix.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return suffix;
}

const MeshFormat* mesh_format_of(const std::string& path) {
    const std::string suffix = suffix_of(path);
    const auto* const found = std::find_if(formats.begin(), formats.end(),
                                           [&](const MeshFormat& format) { return format.suffix == suffix; });
    return found == formats.end() ? nullptr : found;
}

std::string readable_formats() {
    std::string names;
    for (const MeshFormat& format : formats) names.append(names.empty() ? "" : ", ").append(format.name);
    return names;
}

std::string readable_suffixes(std::string_view word) {
    std::string suffixes;
    for (std::size_t k = 0; k < formats.size(); ++k) {
        if (k > 0 && k + 1 < formats.size()) suffixes += ", ";
        if (k > 0 && k + 1 == formats.size()) suffixes.append(" ").append(word).append(" ");
        suffixes += formats[k].suffix;
    }
    return suffixes;
}

}  // namespace coseg
