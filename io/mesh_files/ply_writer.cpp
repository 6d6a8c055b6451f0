#include "io/mesh_files/ply_writer.hpp"

#include <algorithm>
#include <limits>

#include "io/files/atomic_file.hpp"
#include "io/files/byte_cursor.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/pictures/part_colors.hpp"

namespace coseg {

namespace {

constexpr int most_short_corners = std::numeric_limits<std::uint8_t>::max();

/// Polygons of more than 255 corners need a longer count than the one every viewer reads.
bool needs_long_count(const PolygonMesh& mesh) {
    for (std::size_t f = 0; f + 1 < mesh.offsets.size(); ++f) {
        if (mesh.offsets[f + 1] - mesh.offsets[f] > most_short_corners) return true;
    }
    return false;
}

std::string header(const PolygonMesh& mesh, bool has_long_count) {
    return "ply\nformat binary_little_endian 1.0\ncomment coseg: faces coloured by part\nelement vertex " +
           std::to_string(mesh.vertex_count()) +
           "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
           std::to_string(mesh.face_count()) + "\nproperty list " + (has_long_count ? "int" : "uchar") +
           " int vertex_indices\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n";
}

}  // namespace

void write_colored_ply(const std::string& path, const PolygonMesh& mesh, const std::vector<int>& labels) {
    if (labels.size() != static_cast<std::size_t>(mesh.face_count())) {
        throw Error(ExitCode::internal, path + ": " + std::to_string(labels.size()) + " labels for " +
                                            std::to_string(mesh.face_count()) + " faces");
    }
    const bool has_long_count = needs_long_count(mesh);
    std::string bytes = header(mesh, has_long_count);
    bytes.reserve(bytes.size() + 12 * mesh.vertices.size() + 4 * mesh.corners.size() + 7 * labels.size());
    for (const Eigen::Vector3d& p : mesh.vertices) {
        for (int k = 0; k < 3; ++k) append_little_endian(bytes, static_cast<float>(p[k]));
    }
    for (std::size_t f = 0; f < labels.size(); ++f) {
        const int size = mesh.offsets[f + 1] - mesh.offsets[f];
        if (has_long_count)
            append_little_endian(bytes, static_cast<std::int32_t>(size));
        else
            append_little_endian(bytes, static_cast<std::uint8_t>(size));
        for (int k = mesh.offsets[f]; k < mesh.offsets[f + 1]; ++k) {
            append_little_endian(bytes, static_cast<std::int32_t>(mesh.corners[at(k)]));
        }
        for (const std::uint8_t channel : part_color(labels[f])) append_little_endian(bytes, channel);
    }
    write_file(path, bytes);
}

}  // namespace coseg
