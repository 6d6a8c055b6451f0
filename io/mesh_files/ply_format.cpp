#include "io/mesh_files/ply_format.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "io/files/atomic_file.hpp"
#include "io/files/byte_cursor.hpp"
#include "io/files/text_cursor.hpp"
#include "io/mesh_files/mesh_limits.hpp"
#include "io/mesh_files/ply_header.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/pictures/part_colors.hpp"

namespace coseg {

namespace {

/// Values one after the other, from text or from binary data.
class ValueSource {
  public:
    ValueSource(std::string_view bytes, const PlyHeader& header, const std::string& path)
        : is_binary_(header.is_binary),
          text_(bytes.substr(header.data_offset), path, 0),
          binary_(bytes, header.data_offset, header.is_big_endian) {}

    /// False at the end of the data, or where a word is no number.
    bool read(PlyScalar type, double& value) {
        if (!is_binary_) return parse_real(text_.word_on_any_line(), value);
        switch (type) {
            case PlyScalar::int8:
                return read_as<std::int8_t>(value);
            case PlyScalar::uint8:
                return read_as<std::uint8_t>(value);
            case PlyScalar::int16:
                return read_as<std::int16_t>(value);
            case PlyScalar::uint16:
                return read_as<std::uint16_t>(value);
            case PlyScalar::int32:
                return read_as<std::int32_t>(value);
            case PlyScalar::uint32:
                return read_as<std::uint32_t>(value);
            case PlyScalar::float32:
                return read_as<float>(value);
            case PlyScalar::float64:
                return read_as<double>(value);
        }
        return false;
    }

    [[nodiscard]] std::int64_t line() const { return text_.line(); }

  private:
    template <typename T>
    bool read_as(double& value) {
        T raw{};
        if (!binary_.read(raw)) return false;
        value = static_cast<double>(raw);
        return true;
    }

    bool is_binary_;
    TextCursor text_;
    ByteCursor binary_;
};

class PlyReader {
  public:
    PlyReader(std::string_view bytes, const std::string& path)
        : path_(path),
          header_(read_ply_header(bytes, path)),
          data_bytes_(bytes.size() - header_.data_offset),
          source_(bytes, header_, path) {}

    PolygonMesh run() {
        bool has_faces = false;
        mesh_.offsets.push_back(0);
        for (const PlyElement& element : header_.elements) {
            if (element.name == "vertex") {
                read_vertices(element);
            } else if (element.name == "face") {
                read_faces(element);
                has_faces = true;
            } else if (!has_faces || mesh_.vertices.empty()) {
                skip(element);
            }
        }
        if (!has_faces) fail("the PLY file has no element 'face'; export the mesh with faces");
        check_indices();
        return std::move(mesh_);
    }

  private:
    [[noreturn]] void fail(const std::string& sentence) const {
        const std::string line =
            header_.is_binary
                ? ""
                : ":" + std::to_string(header_.lines + std::max<std::int64_t>(source_.line(), 1));
        throw Error(ExitCode::input, path_ + line + ": " + sentence);
    }

    /// As many elements as the header promises, but no more than the file has room for.
    [[nodiscard]] std::size_t believed_count(const PlyElement& element) const {
        const std::size_t bytes = std::max<std::size_t>(1, least_bytes(element, header_.is_binary));
        return std::min(at(element.count), data_bytes_ / bytes + 1);
    }

    double value_of(PlyScalar type, const PlyElement& element, std::int64_t i) {
        double value = 0.0;
        if (source_.read(type, value)) return value;
        fail(element.name + " " + std::to_string(i) + " of " + std::to_string(element.count) +
             " is cut short or not a number; export the mesh again");
    }

    std::int64_t list_size(const PlyProperty& property, const PlyElement& element, std::int64_t i) {
        const double size = value_of(*property.list_count, element, i);
        if (!(size >= 0.0 && size <= static_cast<double>(most_corners)) || size != std::floor(size)) {
            fail(element.name + " " + std::to_string(i) +
                 " has a list of impossible length; export the mesh again");
        }
        return static_cast<std::int64_t>(size);
    }

    void skip_property(const PlyProperty& property, const PlyElement& element, std::int64_t i) {
        const std::int64_t values = property.list_count ? list_size(property, element, i) : 1;
        for (std::int64_t k = 0; k < values; ++k) value_of(property.type, element, i);
    }

    void skip(const PlyElement& element) {
        if (element.properties.empty()) return;
        for (std::int64_t i = 0; i < element.count; ++i) {
            for (const PlyProperty& property : element.properties) skip_property(property, element, i);
        }
    }

    /// 0, 1, 2 for x, y, z; -1 for any other property.
    static int axis_of(const PlyProperty& property) {
        if (property.list_count || property.name.size() != 1) return -1;
        return property.name[0] >= 'x' && property.name[0] <= 'z' ? property.name[0] - 'x' : -1;
    }

    void read_vertices(const PlyElement& element) {
        std::vector<int> axes;
        for (const PlyProperty& property : element.properties) axes.push_back(axis_of(property));
        for (int axis = 0; axis < 3; ++axis) {
            if (std::find(axes.begin(), axes.end(), axis) != axes.end()) continue;
            fail("the vertices have no coordinate '" + std::string(1, static_cast<char>('x' + axis)) +
                 "'; export the mesh again");
        }
        if (std::ssize(mesh_.vertices) + element.count > most_vertices) fail(too_many_vertices);
        if (mesh_.vertices.empty()) mesh_.vertices.reserve(believed_count(element));
        for (std::int64_t i = 0; i < element.count; ++i) read_vertex(element, axes, i);
    }

    void read_vertex(const PlyElement& element, const std::vector<int>& axes, std::int64_t i) {
        Eigen::Vector3d point = Eigen::Vector3d::Zero();
        for (std::size_t p = 0; p < axes.size(); ++p) {
            const PlyProperty& property = element.properties[p];
            if (axes[p] < 0) {
                skip_property(property, element, i);
                continue;
            }
            const double value = value_of(property.type, element, i);
            if (!is_usable_coordinate(value)) fail(bad_coordinate(i, value));
            point[axes[p]] = value;
        }
        mesh_.vertices.push_back(point);
    }

    static bool is_corner_list(const PlyProperty& property) {
        return property.list_count && (property.name == "vertex_indices" || property.name == "vertex_index");
    }

    void read_faces(const PlyElement& element) {
        if (std::count_if(element.properties.begin(), element.properties.end(), is_corner_list) != 1) {
            fail("the faces need one list 'vertex_indices'; export the mesh again");
        }
        if (mesh_.corners.empty()) {
            mesh_.offsets.reserve(believed_count(element) + 1);
            mesh_.corners.reserve(std::min(3 * at(element.count), data_bytes_));
        }
        for (std::int64_t i = 0; i < element.count; ++i) {
            for (const PlyProperty& property : element.properties) {
                if (is_corner_list(property))
                    read_corners(property, element, i);
                else
                    skip_property(property, element, i);
            }
        }
    }

    void read_corners(const PlyProperty& property, const PlyElement& element, std::int64_t i) {
        const std::int64_t size = list_size(property, element, i);
        if (size < 1) fail("face " + std::to_string(i) + " has no corners; correct the face");
        for (std::int64_t k = 0; k < size; ++k) {
            const double index = value_of(property.type, element, i);
            if (!(index >= 0.0 && index < static_cast<double>(most_vertices)) || index != std::floor(index)) {
                fail("face " + std::to_string(i) +
                     " has a corner that is no vertex number; correct the face");
            }
            mesh_.corners.push_back(static_cast<int>(index));
        }
        if (std::ssize(mesh_.corners) > most_corners) fail(too_many_corners);
        mesh_.offsets.push_back(static_cast<int>(mesh_.corners.size()));
    }

    /// Faces may come before vertices, so that their corners can be checked at the end only.
    void check_indices() const {
        const int vertices = mesh_.vertex_count();
        const auto bad = std::find_if(mesh_.corners.begin(), mesh_.corners.end(),
                                      [&](int corner) { return corner >= vertices; });
        if (bad == mesh_.corners.end()) return;
        const auto place = static_cast<int>(bad - mesh_.corners.begin());
        const auto end_of_face = std::upper_bound(mesh_.offsets.begin(), mesh_.offsets.end(), place);
        throw Error(ExitCode::input,
                    path_ + ": " + bad_index(end_of_face - mesh_.offsets.begin() - 1, *bad, vertices));
    }

    std::string path_;
    PlyHeader header_;
    std::size_t data_bytes_;
    ValueSource source_;
    PolygonMesh mesh_;
};

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

PolygonMesh read_ply(std::string_view bytes, const std::string& path) { return PlyReader(bytes, path).run(); }

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

void write_ply(const std::string& path, const PolygonMesh& mesh, const FaceArrays& arrays) {
    write_colored_ply(path, mesh, parts_of(arrays, mesh.face_count(), path));
}

}  // namespace coseg
