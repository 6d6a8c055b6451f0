#include "io/mesh_files/mesh_reader.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "io/files/file_contents.hpp"
#include "io/mesh_files/mesh_check.hpp"
#include "io/mesh_files/polygon_importer.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

std::string lower_case_extension(const std::string& path) {
    std::string extension = std::filesystem::path(path).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

void refuse_unknown_extension(const std::string& path) {
    if (has_mesh_extension(path)) return;
    const std::string extension = lower_case_extension(path);
    throw Error(ExitCode::input, path + ": meshes are read from .off, .obj, .ply and .stl files, not from " +
                                     (extension.empty() ? "files without an extension" : extension));
}

CheckedMesh check_bytes(std::string_view bytes, const std::string& path) {
    const std::string extension = lower_case_extension(path);
    if (extension == ".off") return check_off(bytes, path);
    if (extension == ".obj") return check_obj(bytes, path);
    if (extension == ".ply") return check_ply(bytes, path);
    return check_stl(bytes, path);
}

/// Area is wanted, not measured: the sum over fans about first corners, in units of the largest extent.
bool has_area(const PolygonMesh& mesh) {
    Eigen::Vector3d low = mesh.vertices.front();
    Eigen::Vector3d high = low;
    for (const Eigen::Vector3d& p : mesh.vertices) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    const double extent = (high - low).maxCoeff();
    if (!(extent > 0.0)) return false;
    double sum = 0.0;
    for (int f = 0; f < mesh.face_count(); ++f) {
        const int begin = mesh.offsets[at(f)];
        const int end = mesh.offsets[at(f) + 1];
        const auto corner = [&](int k) {
            return Eigen::Vector3d((mesh.vertices[at(mesh.corners[at(k)])] - low) / extent);
        };
        for (int k = begin + 1; k + 1 < end; ++k) {
            const Eigen::Vector3d u = corner(k) - corner(begin);
            const Eigen::Vector3d v = corner(k + 1) - corner(begin);
            sum += Eigen::Vector3d(u.y() * v.z() - u.z() * v.y(), u.z() * v.x() - u.x() * v.z(),
                                   u.x() * v.y() - u.y() * v.x())
                       .norm();
        }
    }
    return sum > 0.0;
}

}  // namespace

bool has_mesh_extension(const std::string& path) {
    const std::string extension = lower_case_extension(path);
    return extension == ".off" || extension == ".obj" || extension == ".ply" || extension == ".stl";
}

PolygonMesh parse_mesh(std::string_view bytes, const std::string& path) {
    refuse_unknown_extension(path);
    CheckedMesh checked = check_bytes(bytes, path);
    if (checked.face_count == 0) {
        throw Error(ExitCode::input, path + ": the mesh has no faces; export it with its faces");
    }
    PolygonMesh mesh = import_polygons(std::move(checked), path);
    if (!has_area(mesh)) {
        throw Error(
            ExitCode::input,
            path + ": the mesh has no area, all its faces are points or lines; check the coordinates");
    }
    return mesh;
}

PolygonMesh read_mesh(const std::string& path) {
    refuse_unknown_extension(path);
    return parse_mesh(read_file(path), path);
}

}  // namespace coseg
