#include "io/mesh_files/ply_format.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "io/files/atomic_file.hpp"
#include "io/files/byte_cursor.hpp"
#include "io/files/text_cursor.hpp"
#include "io/mesh_files/lost_digits.hpp"
#include "io/mesh_files/mesh_limits.hpp"
#include "io/mesh_files/ply_header.hpp"
#include "io/mesh_files/unusable_vertices.hpp"
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
            case PlyScalar::int64:
                return read_as<std::int64_t>(value);
            case PlyScalar::uint64:
                return read_as<std::uint64_t>(value);
            case PlyScalar::float32:
                return read_as<float>(value);
            case PlyScalar::float64:
                return read_as<double>(value);
            case PlyScalar::unknown:
                return false;
        }
        return false;
    }

    /// Passes over a value, which in text may be any word. False at the end of the data.
    bool skip(PlyScalar type) {
        if (!is_binary_) return !text_.word_on_any_line().empty();
        double ignored = 0.0;
        return read(type, ignored);
    }

    [[nodiscard]] std::int64_t line() const { return text_.line(); }

    /// Whether anything but the end of a line follows.
    bool goes_on() { return is_binary_ ? binary_.left() > 2 : !text_.word_on_any_line().empty(); }

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

    ParsedMesh run() {
        const auto last = std::find_if(header_.elements.rbegin(), header_.elements.rend(), is_read).base();
        if (std::none_of(header_.elements.begin(), last, has_faces)) {
            fail(
                "the PLY file has no element 'face' or 'tristrips', only points perhaps; export the mesh "
                "with faces");
        }
        mesh_.offsets.push_back(0);
        for (auto element = header_.elements.begin(); element != last; ++element) {
            if (element->name == "vertex")
                read_vertices(*element);
            else if (has_faces(*element))
                read_faces(*element);
            else
                skip(*element);
        }
        check_indices();
        ParsedMesh parsed = unusable_.left_out_of({std::move(mesh_), {}}, path_);
        if (last == header_.elements.end() && source_.goes_on())
            parsed.warnings.push_back(path_ +
                                      ": the file goes on after the elements that its header promises; "
                                      "what follows is left out");
        const std::optional<std::string> lost =
            has_single_precision() ? lost_digits(parsed.mesh) : std::nullopt;
        if (lost) parsed.warnings.push_back(path_ + ": " + *lost);
        return parsed;
    }

  private:
    static bool has_faces(const PlyElement& element) {
        return element.name == "face" || element.name == "tristrips";
    }
    /// Text may have more digits than its type says.
    [[nodiscard]] bool has_single_precision() const {
        return header_.is_binary &&
               std::any_of(header_.elements.begin(), header_.elements.end(), [](const PlyElement& element) {
                   return element.name == "vertex" &&
                          std::any_of(element.properties.begin(), element.properties.end(),
                                      [](const PlyProperty& property) {
                                          return axis_of(property) >= 0 &&
                                                 property.type == PlyScalar::float32;
                                      });
               });
    }

    static bool is_read(const PlyElement& element) { return element.name == "vertex" || has_faces(element); }

    [[nodiscard]] std::int64_t line() const {
        return header_.is_binary ? 0 : header_.lines + std::max<std::int64_t>(source_.line(), 1);
    }

    [[noreturn]] void fail(const std::string& sentence) const {
        const std::string place = header_.is_binary ? "" : ":" + std::to_string(line());
        throw Error(ExitCode::input, path_ + place + ": " + sentence);
    }

    /// As many elements as the header promises, but no more than the file has room for.
    [[nodiscard]] std::size_t believed_count(const PlyElement& element) const {
        const std::size_t bytes = std::max<std::size_t>(1, least_bytes(element, header_.is_binary));
        return std::min(at(element.count), data_bytes_ / bytes + 1);
    }

    double value_of(PlyScalar type, const PlyElement& element, std::int64_t i) {
        double value = 0.0;
        if (source_.read(type, value)) return value;
        fail_at(element, i);
    }

    [[noreturn]] void fail_at(const PlyElement& element, std::int64_t i) const {
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
        for (std::int64_t k = 0; k < values; ++k) {
            if (!source_.skip(property.type)) fail_at(element, i);
        }
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
            if (!is_usable_coordinate(value)) unusable_.add(std::ssize(mesh_.vertices), value, line());
            point[axes[p]] = value;
        }
        mesh_.vertices.push_back(point);
    }

    /// Of faces, one list of corners each, or of strips of triangles.
    void read_faces(const PlyElement& element) {
        if (std::count_if(element.properties.begin(), element.properties.end(), is_corner_list) != 1) {
            fail("the elements '" + element.name + "' need one list 'vertex_indices'; export the mesh again");
        }
        if (mesh_.corners.empty()) {
            mesh_.offsets.reserve(believed_count(element) + 1);
            mesh_.corners.reserve(std::min(3 * at(element.count), data_bytes_));
        }
        const bool is_strip = element.name == "tristrips";
        for (std::int64_t i = 0; i < element.count; ++i) {
            for (const PlyProperty& property : element.properties) {
                if (!is_corner_list(property))
                    skip_property(property, element, i);
                else if (is_strip)
                    read_strips(property, element, i);
                else
                    read_corners(property, element, i);
            }
        }
    }

    int corner_of(const PlyProperty& property, const PlyElement& element, std::int64_t i, int least) {
        const double index = value_of(property.type, element, i);
        if (index >= least && index < static_cast<double>(most_vertices) && index == std::floor(index))
            return static_cast<int>(index);
        fail(element.name + " " + std::to_string(i) +
             " has a corner that is no vertex number; correct the face");
    }

    void end_face() {
        if (std::ssize(mesh_.corners) > most_corners) fail(too_many_corners);
        mesh_.offsets.push_back(static_cast<int>(mesh_.corners.size()));
    }

    void read_corners(const PlyProperty& property, const PlyElement& element, std::int64_t i) {
        const std::int64_t size = list_size(property, element, i);
        for (std::int64_t k = 0; k < size; ++k) mesh_.corners.push_back(corner_of(property, element, i, 0));
        end_face();
    }

    /// Every corner of a strip makes a triangle with the two before it, every other one turned, so that all
    /// face the same side. -1 begins a new strip. A triangle that repeats a corner only leads the strip on.
    void read_strips(const PlyProperty& property, const PlyElement& element, std::int64_t i) {
        constexpr int restart = -1;
        const std::int64_t size = list_size(property, element, i);
        std::int64_t in_strip = 0;
        std::array<int, 2> before{};
        for (std::int64_t k = 0; k < size; ++k) {
            const int corner = corner_of(property, element, i, restart);
            if (corner == restart) {
                in_strip = 0;
                continue;
            }
            if (in_strip >= 2 && before[0] != before[1] && corner != before[0] && corner != before[1]) {
                const bool is_turned = in_strip % 2 == 1;
                mesh_.corners.insert(mesh_.corners.end(),
                                     {before[is_turned ? 1 : 0], before[is_turned ? 0 : 1], corner});
                end_face();
            }
            before = {before[1], corner};
            ++in_strip;
        }
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
    UnusableVertices unusable_;
};

constexpr int most_short_corners = std::numeric_limits<std::uint8_t>::max();

/// Polygons of more than 255 corners need a longer count than the one every viewer reads.
bool needs_long_count(const PolygonMesh& mesh) {
    for (std::size_t f = 0; f + 1 < mesh.offsets.size(); ++f) {
        if (mesh.offsets[f + 1] - mesh.offsets[f] > most_short_corners) return true;
    }
    return false;
}

std::string header(const PolygonMesh& mesh, bool has_long_count, bool has_doubles, bool has_confidence) {
    const std::string type = has_doubles ? "double" : "float";
    return "ply\nformat binary_little_endian 1.0\ncomment coseg: faces coloured by part\nelement vertex " +
           std::to_string(mesh.vertex_count()) + "\nproperty " + type + " x\nproperty " + type +
           " y\nproperty " + type + " z\nelement face " + std::to_string(mesh.face_count()) +
           "\nproperty list " + (has_long_count ? "int" : "uchar") +
           " int vertex_indices\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n" +
           (has_confidence ? "property float confidence\n" : "") + "end_header\n";
}

}  // namespace

ParsedMesh read_ply(std::string_view bytes, const std::string& path) { return PlyReader(bytes, path).run(); }

void write_colored_ply(const std::string& path, const PolygonMesh& mesh, const std::vector<int>& labels,
                       const std::vector<float>& confidence) {
    if (labels.size() != static_cast<std::size_t>(mesh.face_count()) ||
        (!confidence.empty() && confidence.size() != labels.size())) {
        throw Error(ExitCode::internal, path + ": " + std::to_string(labels.size()) + " labels for " +
                                            std::to_string(mesh.face_count()) + " faces");
    }
    const bool has_long_count = needs_long_count(mesh);
    const bool has_doubles = lost_digits(mesh).has_value();
    std::string bytes = header(mesh, has_long_count, has_doubles, !confidence.empty());
    const std::size_t vertex_bytes = 3 * (has_doubles ? sizeof(double) : sizeof(float));
    bytes.reserve(bytes.size() + vertex_bytes * mesh.vertices.size() + 4 * mesh.corners.size() +
                  11 * labels.size());
    for (const Eigen::Vector3d& p : mesh.vertices) {
        for (const double value : p) {
            if (has_doubles)
                append_little_endian(bytes, value);
            else
                append_little_endian(bytes, static_cast<float>(value));
        }
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
        if (!confidence.empty()) append_little_endian(bytes, confidence[f]);
    }
    write_file(path, bytes);
}

void write_ply(const std::string& path, const PolygonMesh& mesh, const FaceArrays& arrays) {
    write_colored_ply(path, mesh, parts_of(arrays, mesh.face_count(), path));
}

}  // namespace coseg
