#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "io/files/byte_cursor.hpp"
#include "io/files/text_cursor.hpp"
#include "io/mesh_files/mesh_check.hpp"
#include "src/base/error.hpp"

namespace coseg {

namespace {

enum class Scalar { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct Property {
    std::string name;
    Scalar type = Scalar::float32;
    std::optional<Scalar> list_count;  ///< the type of the count if the property is a list
};

struct Element {
    std::string name;
    long long count = 0;
    std::vector<Property> properties;
};

struct Header {
    bool is_binary = false;
    bool is_big_endian = false;
    std::vector<Element> elements;
    std::size_t data_offset = 0;
    int lines = 0;
};

Scalar scalar_named(std::string_view word, const TextCursor& cursor) {
    static const std::map<std::string_view, Scalar> names{
        {"char", Scalar::int8},      {"int8", Scalar::int8},       {"uchar", Scalar::uint8},
        {"uint8", Scalar::uint8},    {"short", Scalar::int16},     {"int16", Scalar::int16},
        {"ushort", Scalar::uint16},  {"uint16", Scalar::uint16},   {"int", Scalar::int32},
        {"int32", Scalar::int32},    {"uint", Scalar::uint32},     {"uint32", Scalar::uint32},
        {"float", Scalar::float32},  {"float32", Scalar::float32}, {"double", Scalar::float64},
        {"float64", Scalar::float64}};
    const auto found = names.find(word);
    if (found == names.end())
        cursor.fail("the header has " + quoted(word) + " where a PLY type should stand");
    return found->second;
}

class HeaderReader {
  public:
    HeaderReader(std::string_view bytes, const std::string& path) : cursor_(bytes, path, 0) {}

    Header run() {
        if (!cursor_.next_line()) cursor_.fail("the file is empty; export the mesh again");
        const std::string_view magic = cursor_.word();
        if (magic != "ply" && magic != "PLY")
            cursor_.fail("a PLY file begins with 'ply', this one with " + quoted(magic));
        while (cursor_.next_line()) {
            const std::string_view keyword = cursor_.word();
            if (keyword == "end_header") return finish();
            if (keyword == "format")
                read_format();
            else if (keyword == "element")
                read_element();
            else if (keyword == "property")
                read_property();
            else if (keyword != "comment" && keyword != "obj_info")
                cursor_.fail("the header has no statement " + quoted(keyword));
        }
        cursor_.fail("the file ends in its header, before 'end_header'; export the mesh again");
    }

  private:
    Header finish() {
        if (!has_format_) cursor_.fail("the header has no 'format' line; export the mesh again");
        header_.data_offset = cursor_.next_line_offset();
        header_.lines = cursor_.line();
        return std::move(header_);
    }

    void read_format() {
        const std::string_view format = cursor_.word();
        header_.is_binary = format != "ascii";
        header_.is_big_endian = format == "binary_big_endian";
        if (header_.is_binary && !header_.is_big_endian && format != "binary_little_endian") {
            cursor_.fail("the PLY format " + quoted(format) + " is unknown");
        }
        has_format_ = true;
    }

    void read_element() {
        Element element;
        element.name = cursor_.word();
        const std::string_view count = cursor_.word();
        if (!parse_integer(count, element.count) || element.count < 0 ||
            element.count > std::numeric_limits<int>::max()) {
            cursor_.fail("the number of elements " + quoted(element.name) + " is " + quoted(count) +
                         ", which is no count");
        }
        header_.elements.push_back(std::move(element));
    }

    void read_property() {
        if (header_.elements.empty())
            cursor_.fail("a property stands before the first element; export the mesh again");
        Property property;
        std::string_view type = cursor_.word();
        if (type == "list") {
            property.list_count = scalar_named(cursor_.word(), cursor_);
            type = cursor_.word();
        }
        property.type = scalar_named(type, cursor_);
        property.name = cursor_.word();
        header_.elements.back().properties.push_back(std::move(property));
    }

    TextCursor cursor_;
    Header header_;
    bool has_format_ = false;
};

/// Values one after the other, from text or from binary data.
class ValueSource {
  public:
    ValueSource(std::string_view bytes, const Header& header, const std::string& path)
        : is_binary_(header.is_binary),
          text_(bytes.substr(header.data_offset), path, 0),
          binary_(bytes, header.data_offset, header.is_big_endian) {}

    /// False at the end of the data, or where a word is no number.
    bool read(Scalar type, double& value) {
        if (!is_binary_) return parse_real(text_.word_on_any_line(), value);
        switch (type) {
            case Scalar::int8:
                return read_as<std::int8_t>(value);
            case Scalar::uint8:
                return read_as<std::uint8_t>(value);
            case Scalar::int16:
                return read_as<std::int16_t>(value);
            case Scalar::uint16:
                return read_as<std::uint16_t>(value);
            case Scalar::int32:
                return read_as<std::int32_t>(value);
            case Scalar::uint32:
                return read_as<std::uint32_t>(value);
            case Scalar::float32:
                return read_as<float>(value);
            case Scalar::float64:
                return read_as<double>(value);
        }
        return false;
    }

    [[nodiscard]] int line() const { return text_.line(); }

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

class PlyCheck {
  public:
    PlyCheck(std::string_view bytes, const std::string& path)
        : path_(path), header_(HeaderReader(bytes, path).run()), source_(bytes, header_, path) {}

    CheckedMesh run() {
        const Element* faces = nullptr;
        for (const Element& element : header_.elements) {
            if (element.name == "vertex")
                read_vertices(element);
            else if (element.name == "face")
                read_faces(*(faces = &element));
            else if (!(faces != nullptr && !mesh_.vertices.empty()))
                skip(element);
        }
        if (faces == nullptr) fail("the PLY file has no element 'face'; export the mesh with faces");
        check_indices();
        mesh_.extension = "ply";
        mesh_.is_binary = true;
        write_plain();
        return std::move(mesh_);
    }

  private:
    [[noreturn]] void fail(const std::string& sentence) const {
        const std::string line =
            header_.is_binary ? "" : ":" + std::to_string(header_.lines + std::max(source_.line(), 1));
        throw Error(ExitCode::input, path_ + line + ": " + sentence);
    }

    double value_of(Scalar type, const Element& element, long long i) {
        double value = 0.0;
        if (source_.read(type, value)) return value;
        fail(element.name + " " + std::to_string(i) + " of " + std::to_string(element.count) +
             " is cut short or not a number; export the mesh again");
    }

    long long list_size(const Property& property, const Element& element, long long i) {
        const double size = value_of(*property.list_count, element, i);
        if (!(size >= 0.0 && size <= static_cast<double>(most_corners)) || size != std::floor(size)) {
            fail(element.name + " " + std::to_string(i) +
                 " has a list of impossible length; export the mesh again");
        }
        return static_cast<long long>(size);
    }

    void skip_property(const Property& property, const Element& element, long long i) {
        const long long values = property.list_count ? list_size(property, element, i) : 1;
        for (long long k = 0; k < values; ++k) value_of(property.type, element, i);
    }

    void skip(const Element& element) {
        if (element.properties.empty()) return;
        for (long long i = 0; i < element.count; ++i) {
            for (const Property& property : element.properties) skip_property(property, element, i);
        }
    }

    void read_vertices(const Element& element) {
        const std::string axes = "xyz";
        for (const char axis : axes) {
            const auto is_axis = [&](const Property& p) {
                return p.name == std::string(1, axis) && !p.list_count;
            };
            if (std::none_of(element.properties.begin(), element.properties.end(), is_axis)) {
                fail("the vertices have no coordinate '" + std::string(1, axis) + "'; export the mesh again");
            }
        }
        for (long long i = 0; i < element.count; ++i) {
            Eigen::Vector3d point = Eigen::Vector3d::Zero();
            for (const Property& property : element.properties) {
                const auto axis = property.name.size() == 1 ? axes.find(property.name[0]) : std::string::npos;
                if (axis == std::string::npos || property.list_count) {
                    skip_property(property, element, i);
                    continue;
                }
                const double value = value_of(property.type, element, i);
                const std::string wrong = bad_coordinate(i, value);
                if (!wrong.empty()) fail(wrong);
                point[static_cast<Eigen::Index>(axis)] = value;
            }
            mesh_.vertices.push_back(point);
        }
    }

    static bool is_corner_list(const Property& property) {
        return property.list_count && (property.name == "vertex_indices" || property.name == "vertex_index");
    }

    void read_faces(const Element& element) {
        if (std::count_if(element.properties.begin(), element.properties.end(), is_corner_list) != 1) {
            fail("the faces need one list 'vertex_indices'; export the mesh again");
        }
        for (long long i = 0; i < element.count; ++i) {
            for (const Property& property : element.properties) {
                if (is_corner_list(property))
                    read_corners(property, element, i);
                else
                    skip_property(property, element, i);
            }
        }
        mesh_.face_count += static_cast<int>(element.count);
    }

    void read_corners(const Property& property, const Element& element, long long i) {
        const long long size = list_size(property, element, i);
        if (size < 1) fail("face " + std::to_string(i) + " has no corners; correct the face");
        sizes_.push_back(static_cast<int>(size));
        for (long long k = 0; k < size; ++k) {
            const double index = value_of(property.type, element, i);
            if (!(index >= 0.0 && index < static_cast<double>(std::numeric_limits<int>::max())) ||
                index != std::floor(index)) {
                fail("face " + std::to_string(i) +
                     " has a corner that is no vertex number; correct the face");
            }
            corners_.push_back(static_cast<int>(index));
        }
        if (static_cast<long long>(corners_.size()) > most_corners)
            fail("the mesh has too many corners; split it");
    }

    void check_indices() const {
        std::size_t next = 0;
        for (std::size_t f = 0; f < sizes_.size(); ++f) {
            for (int k = 0; k < sizes_[f]; ++k) {
                const int corner = corners_[next++];
                if (corner < static_cast<int>(mesh_.vertices.size())) continue;
                throw Error(ExitCode::input, path_ + ": " +
                                                 bad_index(static_cast<long long>(f), corner,
                                                           static_cast<long long>(mesh_.vertices.size())));
            }
        }
    }

    void write_plain() {
        std::string& plain = mesh_.plain;
        plain = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                std::to_string(mesh_.vertices.size()) +
                "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
                std::to_string(sizes_.size()) + "\nproperty list int int vertex_indices\nend_header\n";
        plain.reserve(plain.size() + 12 * mesh_.vertices.size() + 4 * (sizes_.size() + corners_.size()));
        for (const Eigen::Vector3d& p : mesh_.vertices) {
            for (int k = 0; k < 3; ++k) append_little_endian(plain, static_cast<float>(p[k]));
        }
        std::size_t next = 0;
        for (const int size : sizes_) {
            append_little_endian(plain, static_cast<std::int32_t>(size));
            for (int k = 0; k < size; ++k)
                append_little_endian(plain, static_cast<std::int32_t>(corners_[next++]));
        }
    }

    std::string path_;
    Header header_;
    ValueSource source_;
    CheckedMesh mesh_;
    std::vector<int> sizes_;
    std::vector<int> corners_;
};

}  // namespace

CheckedMesh check_ply(std::string_view bytes, const std::string& path) { return PlyCheck(bytes, path).run(); }

}  // namespace coseg
