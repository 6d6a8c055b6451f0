#include "io/mesh_files/mesh_reader.hpp"

#include <optional>

#include "io/files/file_contents.hpp"
#include "io/files/text_encoding.hpp"
#include "io/mesh_files/foreign_content.hpp"
#include "io/mesh_files/mesh_format.hpp"
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

ParsedMesh parsed_by(const MeshFormat& format, std::string_view bytes, const std::string& path) {
    ParsedMesh parsed = format.read(bytes, path);
    if (parsed.mesh.face_count() == 0)
        throw Error(ExitCode::input, path + ": the mesh has no faces; export it with its faces");
    if (!has_area(parsed.mesh)) {
        throw Error(
            ExitCode::input,
            path + ": the mesh has no area, all its faces are points or lines; check the coordinates");
    }
    return parsed;
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
        return parsed_by(format, text, path);
    } catch (const Error& error) {
        const std::optional<std::string> what = foreign_content(text, format.name);
        if (!what || error.code() != ExitCode::input) throw;
        throw Error(ExitCode::input, path + ": the file is " + *what);
    }
}

PolygonMesh read_mesh(const std::string& path) { return parse_mesh(mesh_file_bytes(path), path).mesh; }

}  // namespace coseg
