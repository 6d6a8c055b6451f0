#include "mpi_drivers/finished_runs/part_export.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <string_view>
#include <utility>

#include "io/files/folder_entries.hpp"
#include "io/mesh_files/mesh_reader.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/mesh/face_selection.hpp"

namespace coseg {

namespace {

bool is_of_this_kind(const MeshFormat& format, const std::string& path) {
    const MeshFormat* source = readable_format_of(path);
    return format.write_like != nullptr && source != nullptr && source->read == format.read;
}

const std::vector<int>* pieces_in(const FaceArrays& arrays) {
    for (const auto& [name, values] : arrays.labels) {
        if (name == "piece") return &values;
    }
    return nullptr;
}

/// The name with characters that file systems refuse replaced. Of a long one the beginning, as the number of
/// the part before it tells it from others; no character is torn.
std::string as_file_name(const std::string& name) {
    constexpr std::size_t longest = 100;  // bytes, of the 255 that a name may have
    std::size_t end = std::min(name.size(), longest);
    while (end > 0 && end < name.size() && (static_cast<unsigned char>(name[end]) & 0xC0U) == 0x80U) --end;
    std::string safe = name.substr(0, end);
    for (char& c : safe) {
        const bool is_control = static_cast<unsigned char>(c) < ' ';
        if (is_control || std::string_view("/\\:*?\"<>| ").find(c) != std::string_view::npos) c = '_';
    }
    return safe;
}

std::string file_of(const FaceArrays& arrays, int part, int piece) {
    const std::string number = "part_" + std::to_string(part);
    const std::string name = part_name(arrays, part);
    return number + (name == number ? "" : "_" + as_file_name(name)) +
           (piece < 0 ? "" : "_" + std::to_string(piece));
}

/// Removes the parts of an earlier export, which may be others.
void remove_parts(const std::string& folder, std::string_view suffix) {
    remove_earlier_files(folder, [&](const std::filesystem::path& path) {
        const std::string name = path.filename().string();
        const std::size_t digit = std::string_view("part_").size();
        return name.starts_with("part_") && name.ends_with(suffix) && name.size() > digit &&
               name[digit] >= '0' && name[digit] <= '9';
    });
}

/// The values of these faces only.
FaceArrays selected_arrays(const FaceArrays& arrays, const std::vector<int>& faces) {
    FaceArrays selected;
    selected.part_names = arrays.part_names;
    for (const auto& [name, values] : arrays.labels) {
        selected.labels.emplace_back(name, std::vector<int>{});
        for (const int f : faces) selected.labels.back().second.push_back(values[at(f)]);
    }
    for (const auto& [name, values] : arrays.values) {
        selected.values.emplace_back(name, std::vector<double>{});
        for (const int f : faces) selected.values.back().second.push_back(values[at(f)]);
    }
    return selected;
}

/// The part of other faces becomes -1, which leaves them out.
FaceArrays without_others(const FaceArrays& arrays, const std::vector<int>& faces) {
    FaceArrays masked = arrays;
    std::vector<int>& parts = masked.labels.front().second;
    std::vector<int> kept(parts.size(), -1);
    for (const int f : faces) kept[at(f)] = parts[at(f)];
    parts = std::move(kept);
    return masked;
}

}  // namespace

void write_whole(const MeshFormat& format, const std::string& path, const LabelledMesh& shape,
                 const FaceArrays& arrays) {
    if (is_of_this_kind(format, shape.path))
        format.write_like(path, {shape.path, mesh_file_bytes(shape.path)}, arrays);
    else
        format.write(path, shape.mesh, arrays);
}

void write_split(const MeshFormat& format, const std::string& folder, const LabelledMesh& shape,
                 const FaceArrays& arrays, int parts) {
    std::error_code cause;
    std::filesystem::create_directories(folder, cause);
    if (cause) throw Error(ExitCode::output, folder + ": cannot be made (" + cause.message() + ")");
    remove_parts(folder, format.suffix);
    if (format.write_shared != nullptr) format.write_shared(folder, parts);
    const std::vector<int>* pieces = pieces_in(arrays);
    std::map<std::pair<int, int>, std::vector<int>> faces;
    for (std::size_t f = 0; f < shape.part.size(); ++f)
        faces[{shape.part[f], pieces == nullptr ? -1 : (*pieces)[f]}].push_back(static_cast<int>(f));
    const bool is_like = is_of_this_kind(format, shape.path);
    const MeshSource source{shape.path, is_like ? mesh_file_bytes(shape.path) : ""};
    for (const auto& [what, list] : faces) {
        const std::string path =
            folder + "/" + file_of(arrays, what.first, what.second) + std::string(format.suffix);
        if (is_like)
            format.write_like(path, source, without_others(arrays, list));
        else
            format.write(path, selected_faces(shape.mesh, list), selected_arrays(arrays, list));
    }
}

}  // namespace coseg
