#include "io/mesh_files/ply_header.hpp"

#include <limits>
#include <map>

#include "io/files/text_cursor.hpp"

namespace coseg {

namespace {

PlyScalar scalar_named(std::string_view word) {
    using enum PlyScalar;
    static const std::map<std::string_view, PlyScalar> names{
        {"char", int8},      {"int8", int8},      {"uchar", uint8},   {"uint8", uint8},
        {"short", int16},    {"int16", int16},    {"ushort", uint16}, {"uint16", uint16},
        {"int", int32},      {"int32", int32},    {"uint", uint32},   {"uint32", uint32},
        {"int64", int64},    {"uint64", uint64},  {"float", float32}, {"float32", float32},
        {"double", float64}, {"float64", float64}};
    const auto found = names.find(word);
    return found == names.end() ? unknown : found->second;
}

std::size_t bytes_of(PlyScalar type) {
    switch (type) {
        case PlyScalar::int8:
        case PlyScalar::uint8:
            return 1;
        case PlyScalar::int16:
        case PlyScalar::uint16:
            return 2;
        case PlyScalar::int32:
        case PlyScalar::uint32:
        case PlyScalar::float32:
            return 4;
        case PlyScalar::int64:
        case PlyScalar::uint64:
        case PlyScalar::float64:
            return 8;
        case PlyScalar::unknown:
            return 0;
    }
    return 0;
}

class HeaderReader {
  public:
    HeaderReader(std::string_view bytes, const std::string& path) : cursor_(bytes, path, 0) {}

    PlyHeader run() {
        if (!cursor_.next_line()) cursor_.fail("the file is empty; export the mesh again");
        const std::string_view magic = cursor_.word();
        if (magic != "ply" && magic != "PLY")
            cursor_.fail("a PLY file begins with 'ply', this one with " + in_quotes(magic));
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
                cursor_.fail("the header has no statement " + in_quotes(keyword));
        }
        cursor_.fail("the file ends in its header, before 'end_header'; export the mesh again");
    }

  private:
    PlyHeader finish() {
        if (!has_format_) cursor_.fail("the header has no 'format' line; export the mesh again");
        if (header_.is_binary && !unknown_type_.empty())
            cursor_.fail("the header has " + unknown_type_ + " where a PLY type should stand");
        header_.data_offset = cursor_.next_line_offset();
        header_.lines = cursor_.line();
        return std::move(header_);
    }

    void read_format() {
        const std::string_view format = cursor_.word();
        header_.is_binary = format != "ascii";
        header_.is_big_endian = format == "binary_big_endian";
        if (header_.is_binary && !header_.is_big_endian && format != "binary_little_endian") {
            cursor_.fail("the PLY format " + in_quotes(format) + " is unknown");
        }
        has_format_ = true;
    }

    void read_element() {
        PlyElement element;
        element.name = printable(cursor_.word());
        const std::string_view count = cursor_.word();
        if (!parse_integer(count, element.count) || element.count < 0 ||
            element.count > std::numeric_limits<int>::max()) {
            cursor_.fail("the number of elements " + in_quotes(element.name) + " is " + in_quotes(count) +
                         ", which is no count");
        }
        header_.elements.push_back(std::move(element));
    }

    void read_property() {
        if (header_.elements.empty())
            cursor_.fail("a property stands before the first element; export the mesh again");
        PlyProperty property;
        std::string_view type = cursor_.word();
        if (type == "list") {
            property.list_count = type_named(cursor_.word());
            type = cursor_.word();
        }
        property.type = type_named(type);
        property.name = cursor_.word();
        header_.elements.back().properties.push_back(std::move(property));
    }

    PlyScalar type_named(std::string_view word) {
        const PlyScalar type = scalar_named(word);
        if (type == PlyScalar::unknown && unknown_type_.empty()) unknown_type_ = in_quotes(word);
        return type;
    }

    TextCursor cursor_;
    PlyHeader header_;
    std::string unknown_type_;  ///< the first, in quotes
    bool has_format_ = false;
};

}  // namespace

bool is_corner_list(const PlyProperty& property) {
    return property.list_count && (property.name == "vertex_indices" || property.name == "vertex_index");
}

PlyHeader read_ply_header(std::string_view bytes, const std::string& path) {
    return HeaderReader(bytes, path).run();
}

std::size_t least_bytes(const PlyElement& element, bool is_binary) {
    constexpr std::size_t digit_and_blank = 2;
    std::size_t sum = 0;
    for (const PlyProperty& property : element.properties)
        sum += is_binary ? bytes_of(property.list_count.value_or(property.type)) : digit_and_blank;
    return sum;
}

}  // namespace coseg
