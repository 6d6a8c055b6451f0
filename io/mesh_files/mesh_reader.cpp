#include "io/mesh_files/mesh_reader.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "io/files/file_contents.hpp"
#include "io/files/text_encoding.hpp"
#include "io/mesh_files/foreign_content.hpp"
#include "io/mesh_files/mesh_format.hpp"
#include "io/mesh_files/mesh_limits.hpp"
#include "io/mesh_files/unusable_vertices.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

const MeshFormat& format_of(const std::string& path) {
    const MeshFormat* format = readable_format_of(path);
    if (format != nullptr) return *format;
    const std::string suffix = suffix_of(path);
    throw Error(ExitCode::input, path + ": meshes are read from " + readable_suffixes("and") +
                                     " files, not from " +
                                     (suffix.empty() ? "files without an extension" : suffix));
}

/// Whether any face has area, in units of the largest extent: the areas of its fan about its first corner.
bool has_area(const PolygonMesh& mesh) {
    if (mesh.vertices.empty()) return false;
    Eigen::Vector3d low = mesh.vertices.front();
    Eigen::Vector3d high = low;
    for (const Eigen::Vector3d& p : mesh.vertices) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    const double extent = (high - low).maxCoeff();
    if (!(extent > 0.0)) return false;
    for (int f = 0; f < mesh.face_count(); ++f) {
        const int begin = mesh.offsets[at(f)];
        const int end = mesh.offsets[at(f) + 1];
        const auto corner = [&](int k) {
            return Eigen::Vector3d((mesh.vertices[at(mesh.corners[at(k)])] - low) / extent);
        };
        for (int k = begin + 1; k + 1 < end; ++k) {
            const Eigen::Vector3d u = corner(k) - corner(begin);
            const Eigen::Vector3d v = corner(k + 1) - corner(begin);
            const Eigen::Vector3d normal(u.y() * v.z() - u.z() * v.y(), u.z() * v.x() - u.x() * v.z(),
                                         u.x() * v.y() - u.y() * v.x());
            if (normal.norm() > 0.0) return true;
        }
    }
    return false;
}

/// What no reader gives on.
ParsedMesh with_area(ParsedMesh parsed, const std::string& path) {
    if (parsed.mesh.face_count() == 0)
        throw Error(ExitCode::input, path + ": the mesh has no faces; export it with its faces");
    if (!has_area(parsed.mesh)) {
        throw Error(
            ExitCode::input,
            path + ": the mesh has no area, all its faces are points or lines; check the coordinates");
    }
    return parsed;
}

/// F + 1 offsets. Throws where they do not divide the corners into faces.
std::vector<int> offsets_of(const PolygonView& polygons, const std::string& name) {
    if (!polygons.offsets.empty()) {
        const std::span<const int> offsets = polygons.offsets;
        const bool fits = offsets.front() == 0 && at(offsets.back()) == polygons.corners.size() &&
                          std::is_sorted(offsets.begin(), offsets.end());
        if (fits) return {offsets.begin(), offsets.end()};
        throw Error(ExitCode::input, name +
                                         ": the offsets of the faces must ascend from 0 to the number of "
                                         "corners, which is " +
                                         std::to_string(polygons.corners.size()));
    }
    if (polygons.corners.size() % 3 != 0)
        throw Error(ExitCode::input, name + ": without offsets every face has 3 corners, but there are " +
                                         std::to_string(polygons.corners.size()) + " corners");
    std::vector<int> offsets(polygons.corners.size() / 3 + 1);
    for (std::size_t f = 0; f < offsets.size(); ++f) offsets[f] = static_cast<int>(3 * f);
    return offsets;
}

void refuse_too_large(const PolygonView& polygons, const std::string& name) {
    if (polygons.coordinates.size() % 3 != 0)
        throw Error(ExitCode::input, name + ": a vertex has 3 coordinates, but there are " +
                                         std::to_string(polygons.coordinates.size()) + " numbers");
    if (polygons.coordinates.size() / 3 > at(most_vertices))
        throw Error(ExitCode::input, name + ": " + too_many_vertices);
    if (polygons.corners.size() > at(most_corners))
        throw Error(ExitCode::input, name + ": " + too_many_corners);
}

void refuse_bad_indices(const PolygonMesh& mesh, const std::string& name) {
    for (int f = 0; f < mesh.face_count(); ++f) {
        for (int k = mesh.offsets[at(f)]; k < mesh.offsets[at(f) + 1]; ++k) {
            const int v = mesh.corners[at(k)];
            if (v < 0 || v >= mesh.vertex_count())
                throw Error(ExitCode::input, name + ": " + bad_index(f, v, mesh.vertex_count()));
        }
    }
}

}  // namespace

bool has_mesh_extension(const std::string& path) { return readable_format_of(path) != nullptr; }

std::string mesh_file_bytes(const std::string& path) {
    const MeshFormat& format = format_of(path);
    std::string bytes = read_regular_file(path);
    return format.gather == nullptr ? bytes : format.gather(std::move(bytes), path);
}

ParsedMesh parse_mesh(std::string_view bytes, const std::string& path) {
    const MeshFormat& format = format_of(path);
    if (bytes.empty()) throw Error(ExitCode::input, path + ": the file is empty; export the mesh again");
    const std::optional<std::string> decoded = utf8_of_utf16(bytes);
    const std::string_view text = decoded ? std::string_view(*decoded) : bytes;
    try {
        return with_area(format.read(text, path), path);
    } catch (const Error& error) {
        const std::optional<std::string> what = foreign_content(text, format.name);
        if (!what || error.code() != ExitCode::input) throw;
        throw Error(ExitCode::input, path + ": the file is " + *what);
    }
}

ParsedMesh checked_polygons(const PolygonView& polygons, const std::string& name) {
    refuse_too_large(polygons, name);
    ParsedMesh parsed;
    parsed.mesh.offsets = offsets_of(polygons, name);
    parsed.mesh.corners.assign(polygons.corners.begin(), polygons.corners.end());
    parsed.mesh.vertices.resize(polygons.coordinates.size() / 3);
    UnusableVertices unusable;
    for (std::size_t k = 0; k < polygons.coordinates.size(); ++k) {
        const double coordinate = polygons.coordinates[k];
        if (!is_usable_coordinate(coordinate)) unusable.add(static_cast<std::int64_t>(k / 3), coordinate, 0);
        parsed.mesh.vertices[k / 3][static_cast<Eigen::Index>(k % 3)] = coordinate;
    }
    refuse_bad_indices(parsed.mesh, name);
    return with_area(unusable.left_out_of(std::move(parsed), name), name);
}

PolygonMesh read_mesh(const std::string& path) { return parse_mesh(mesh_file_bytes(path), path).mesh; }

}  // namespace coseg
