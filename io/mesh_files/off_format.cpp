#include "io/mesh_files/off_format.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "io/files/atomic_file.hpp"
#include "io/files/number_text.hpp"
#include "io/files/text_cursor.hpp"
#include "io/mesh_files/mesh_limits.hpp"
#include "io/mesh_files/off_header.hpp"
#include "io/mesh_files/unusable_vertices.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

// The fewest bytes that a vertex ("0 0 0\n"), a face ("1 0\n") and a corner (" 0") take: a header's promises
// are believed no further.
constexpr std::size_t least_vertex_bytes = 6;
constexpr std::size_t least_face_bytes = 4;
constexpr std::size_t least_corner_bytes = 2;

/// How the numbers of a file lie on its lines. OFF is a free format: only the colours behind the corners of a
/// face end with the line.
struct OffLayout {
    /// Every vertex begins a line, and what follows its coordinates there is passed over. Otherwise a vertex
    /// has a fixed number of words.
    bool vertices_by_line = true;
    int words_behind_coordinates = 0;  ///< if not by line
    /// What follows the corners of a face on its line is its colour. Otherwise the next face may follow.
    bool faces_by_line = true;
    /// By line, whether the corners of a face may go on in the next line all the same.
    bool faces_wrap = false;
    bool skips_edge_count = false;
};

/// The layouts that a file with this header may have, the most common ones first. Two of them rarely fit the
/// same file: all but the first must use up every number.
std::vector<OffLayout> possible_layouts(const OffHeader& header) {
    using enum OffHeader::EdgeCount;
    const bool is_alone = header.edge_count == on_next_line || header.edge_count == maybe_on_next_line;
    std::vector<OffLayout> layouts{{.skips_edge_count = is_alone},
                                   {.faces_by_line = false, .skips_edge_count = is_alone},
                                   {.faces_wrap = true, .skips_edge_count = is_alone}};
    const int others = (header.has_normals ? 3 : 0) + (header.has_texture ? 2 : 0);
    for (const bool skips_edge_count : {true, false}) {
        if (skips_edge_count ? !is_alone : header.edge_count == on_next_line) continue;
        for (const int colour_words : {4, 3}) {
            if (colour_words == 3 && !header.has_colours) continue;
            for (const bool faces_by_line : {true, false}) {
                layouts.push_back(
                    {.vertices_by_line = false,
                     .words_behind_coordinates = others + (header.has_colours ? colour_words : 0),
                     .faces_by_line = faces_by_line,
                     .skips_edge_count = skips_edge_count});
            }
        }
    }
    return layouts;
}

class OffReader {
  public:
    OffReader(std::string_view bytes, const std::string& path, const OffHeader& header,
              const OffLayout& layout)
        : cursor_(header.behind), path_(path), header_(header), layout_(layout), size_(bytes.size()) {}

    ParsedMesh run() {
        PolygonMesh& mesh = parsed_.mesh;
        mesh.vertices.reserve(std::min(at(header_.vertex_count), size_ / least_vertex_bytes));
        mesh.offsets.reserve(std::min(at(header_.face_count), size_ / least_face_bytes) + 1);
        mesh.corners.reserve(std::min(3 * at(header_.face_count), size_ / least_corner_bytes));
        if (layout_.skips_edge_count) cursor_.word_on_any_line();
        if (layout_.vertices_by_line) cursor_.skip_line();
        for (std::int64_t v = 0; v < header_.vertex_count; ++v) read_vertex(v);
        mesh.offsets.push_back(0);
        for (std::int64_t f = 0; f < header_.face_count; ++f) read_face(f);
        look_behind_the_faces();
        if (wrapped_face_ >= 0) {
            parsed_.warnings.push_back(path_ + ":" + std::to_string(wrapped_line_) + ": face " +
                                       std::to_string(wrapped_face_) +
                                       " has fewer corners on its line than it says and goes on in the next "
                                       "one; correct the number if it is wrong");
        }
        return unusable_.left_out_of(std::move(parsed_), path_);
    }

  private:
    void read_vertex(std::int64_t v) {
        Eigen::Vector3d point = Eigen::Vector3d::Zero();
        std::string_view word = cursor_.word_on_any_line();
        if (word.empty()) fail_at_end(v, header_.vertex_count, "vertices");
        for (int k = 0; k < header_.coordinates; ++k) {
            if (k > 0) word = layout_.vertices_by_line ? cursor_.word() : cursor_.word_on_any_line();
            double value = 0.0;
            if (!parse_real(word, value)) {
                cursor_.fail("vertex " + std::to_string(v) + " needs " +
                             (header_.has_weight ? "four" : "three") + " coordinates, but one is " +
                             no_number(word));
            }
            if (k < 3)
                point[k] = value;
            else
                point /= value;
        }
        for (const double value : point) {
            if (!is_usable_coordinate(value)) unusable_.add(v, value, cursor_.line());
        }
        parsed_.mesh.vertices.push_back(point);
        if (layout_.vertices_by_line) cursor_.skip_line();
        if (!layout_.vertices_by_line) {
            for (int k = 0; k < layout_.words_behind_coordinates; ++k) cursor_.word_on_any_line();
        }
    }

    void read_face(std::int64_t f) {
        const std::string_view first = cursor_.word_on_any_line();
        if (first.empty()) fail_at_end(f, header_.face_count, "faces");
        std::int64_t corners = 0;
        if (!parse_index(first, corners) || corners < (layout_.faces_by_line ? 0 : 1)) {
            cursor_.fail("face " + std::to_string(f) + " begins with " + in_quotes(first) +
                         " instead of its number of corners");
        }
        if (corners == 0 && !cursor_.word().empty())
            cursor_.fail("face " + std::to_string(f) + " has no corners, but more numbers; correct the line");
        for (std::int64_t k = 0; k < corners; ++k) read_corner(f);
        if (std::ssize(parsed_.mesh.corners) > most_corners) cursor_.fail(too_many_corners);
        parsed_.mesh.offsets.push_back(static_cast<int>(parsed_.mesh.corners.size()));
        if (layout_.faces_by_line) cursor_.skip_line();
    }

    std::string_view corner_word(std::int64_t f) {
        const std::int64_t line = cursor_.line();
        std::string_view word = layout_.faces_by_line ? cursor_.word() : std::string_view();
        if (!word.empty()) return word;
        word = cursor_.word_on_any_line();
        if (word.empty()) fail_at_end(f, header_.face_count, "faces");
        if (!layout_.faces_by_line) return word;
        if (!layout_.faces_wrap) {
            throw Error(ExitCode::input, path_ + ":" + std::to_string(line) + ": face " + std::to_string(f) +
                                             " has fewer corners on its line than it says; correct the line");
        }
        if (wrapped_face_ < 0) {
            wrapped_face_ = f;
            wrapped_line_ = line;
        }
        return word;
    }

    /// Whole numbers may have a point, but where the layout is guessed they tell corners from colours.
    [[nodiscard]] bool parse_index(std::string_view word, std::int64_t& index) const {
        const bool is_guessed = !layout_.faces_by_line || layout_.faces_wrap;
        return is_guessed ? parse_integer(word, index) : parse_whole(word, index);
    }

    void read_corner(std::int64_t f) {
        const std::string_view word = corner_word(f);
        std::int64_t index = 0;
        if (!parse_index(word, index)) {
            cursor_.fail("face " + std::to_string(f) + " has " + in_quotes(word) +
                         " where a vertex number should stand");
        }
        if (index < 0 || index >= header_.vertex_count)
            cursor_.fail(bad_index(f, index, header_.vertex_count));
        parsed_.mesh.corners.push_back(static_cast<int>(index));
    }

    /// What stands behind the promised faces was not written by the one who counted them.
    void look_behind_the_faces() {
        const std::string_view word = cursor_.word_on_any_line();
        if (word.empty()) return;
        double number = 0.0;
        const bool is_plain = layout_.vertices_by_line && layout_.faces_by_line;
        if (!is_plain && parse_real(word, number))
            cursor_.fail("there are more numbers than the header promises; correct the counts in the header");
        parsed_.warnings.push_back(path_ + ":" + std::to_string(cursor_.line()) +
                                   ": the file goes on after the " + std::to_string(header_.face_count) +
                                   " faces that its header promises; what follows, from " + in_quotes(word) +
                                   " on, is left out");
    }

    [[noreturn]] void fail_at_end(std::int64_t found, std::int64_t promised, const std::string& what) const {
        cursor_.fail("the file ends after " + std::to_string(found) + " of the " + std::to_string(promised) +
                     " " + what + " its header promises; export the mesh again");
    }

    TextCursor cursor_;
    const std::string& path_;
    const OffHeader& header_;
    OffLayout layout_;
    std::size_t size_;
    ParsedMesh parsed_;
    UnusableVertices unusable_;
    std::int64_t wrapped_face_ = -1;  ///< the first face whose corners go on in the next line
    std::int64_t wrapped_line_ = 0;
};

std::string header(int vertices, int faces) {
    return "OFF\n" + std::to_string(vertices) + " " + std::to_string(faces) + " 0\n";
}

}  // namespace

ParsedMesh read_off(std::string_view bytes, const std::string& path) {
    const OffHeader header = read_off_header(bytes, path);
    std::optional<Error> reason;  // why the most common layout does not fit
    for (const OffLayout& layout : possible_layouts(header)) {
        try {
            return OffReader(bytes, path, header, layout).run();
        } catch (const Error& error) {
            if (!reason) reason = error;
        }
    }
    throw Error(*reason);
}

void write_off(const std::string& path, const PolygonMesh& mesh) {
    std::string text = header(mesh.vertex_count(), mesh.face_count());
    for (const Eigen::Vector3d& p : mesh.vertices) append_point(text, p);
    for (std::size_t f = 0; f + 1 < mesh.offsets.size(); ++f) {
        const int begin = mesh.offsets[f];
        const int end = mesh.offsets[f + 1];
        append_number(text, end - begin, end > begin ? ' ' : '\n');
        for (int k = begin; k < end; ++k) append_number(text, mesh.corners[at(k)], k + 1 < end ? ' ' : '\n');
    }
    write_file(path, text);
}

void write_off(const std::string& path, const TriMesh& mesh) {
    std::string text = header(mesh.vertex_count(), mesh.face_count());
    for (int v = 0; v < mesh.vertex_count(); ++v) append_point(text, mesh.vertices.col(v));
    for (int f = 0; f < mesh.face_count(); ++f) {
        text += "3 ";
        for (int k = 0; k < 3; ++k) append_number(text, mesh.faces(k, f), k < 2 ? ' ' : '\n');
    }
    write_file(path, text);
}

void write_labelled_off(const std::string& path, const PolygonMesh& mesh, const FaceArrays& arrays) {
    parts_of(arrays, mesh.face_count(), path);
    write_off(path, mesh);
}

}  // namespace coseg
