#include "io/mesh_files/off_format.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>

#include "io/files/atomic_file.hpp"
#include "io/files/text_cursor.hpp"
#include "io/mesh_files/mesh_limits.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

// The fewest bytes that a vertex ("0 0 0\n"), a face ("1 0\n") and a corner (" 0") take: a header's promises
// are believed no further.
constexpr std::size_t least_vertex_bytes = 6;
constexpr std::size_t least_face_bytes = 4;
constexpr std::size_t least_corner_bytes = 2;

class OffReader {
  public:
    OffReader(std::string_view bytes, const std::string& path)
        : cursor_(bytes, path, '#'), size_(bytes.size()) {}

    PolygonMesh run() {
        read_header();
        mesh_.vertices.reserve(std::min(at(vertex_count_), size_ / least_vertex_bytes));
        mesh_.offsets.reserve(std::min(at(face_count_), size_ / least_face_bytes) + 1);
        mesh_.corners.reserve(std::min(3 * at(face_count_), size_ / least_corner_bytes));
        for (std::int64_t v = 0; v < vertex_count_; ++v) read_vertex(v);
        mesh_.offsets.push_back(0);
        for (std::int64_t f = 0; f < face_count_; ++f) read_face(f);
        if (cursor_.next_line()) {
            cursor_.fail("the file goes on after the " + std::to_string(face_count_) +
                         " faces its header promises; correct the counts in the header");
        }
        return std::move(mesh_);
    }

  private:
    void read_header() {
        if (!cursor_.next_line()) cursor_.fail("the file is empty; export the mesh again");
        std::string_view keyword = cursor_.word();
        for (const std::string_view prefix : {"ST", "C", "N"}) {
            if (keyword.substr(0, prefix.size()) == prefix) keyword.remove_prefix(prefix.size());
        }
        if (keyword == "4OFF" || keyword == "nOFF" || keyword == "4nOFF") {
            cursor_.fail("only three coordinates a vertex are understood; export the mesh as plain OFF");
        }
        if (keyword.substr(0, 3) != "OFF")
            cursor_.fail("an OFF file begins with OFF, this one with " + in_quotes(keyword));
        keyword.remove_prefix(3);  // some collections write the first count right behind: "OFF490 518 0"
        const std::string_view first = keyword.empty() ? cursor_.word_on_any_line() : keyword;
        if (first == "BINARY")
            cursor_.fail("binary OFF is not understood; export the mesh as ASCII OFF or PLY");
        vertex_count_ = count(first, "vertices");
        face_count_ = count(cursor_.word_on_any_line(), "faces");
    }

    std::int64_t count(std::string_view word, const std::string& what) const {
        std::int64_t value = 0;
        if (word.empty()) cursor_.fail("the file ends in its header, before the number of " + what);
        if (!parse_integer(word, value) || value < 0 || value > most_vertices) {
            cursor_.fail("the number of " + what + " in the header is " + in_quotes(word) +
                         ", which is no count");
        }
        return value;
    }

    void read_vertex(std::int64_t v) {
        if (!cursor_.next_line()) fail_at_end(v, vertex_count_, "vertices");
        Eigen::Vector3d point;
        for (int k = 0; k < 3; ++k) {
            const std::string_view word = cursor_.word();
            if (!parse_real(word, point[k])) {
                cursor_.fail("vertex " + std::to_string(v) + " needs three coordinates, but one is " +
                             in_quotes(word));
            }
            if (!is_usable_coordinate(point[k])) cursor_.fail(bad_coordinate(v, point[k]));
        }
        mesh_.vertices.push_back(point);
    }

    void read_face(std::int64_t f) {
        if (!cursor_.next_line()) fail_at_end(f, face_count_, "faces");
        const std::string_view first = cursor_.word();
        std::int64_t corners = 0;
        if (!parse_integer(first, corners) || corners < 1) {
            cursor_.fail("face " + std::to_string(f) + " begins with " + in_quotes(first) +
                         " instead of its number of corners");
        }
        for (std::int64_t k = 0; k < corners; ++k) read_corner(f);
        if (std::ssize(mesh_.corners) > most_corners) cursor_.fail(too_many_corners);
        mesh_.offsets.push_back(static_cast<int>(mesh_.corners.size()));
    }

    void read_corner(std::int64_t f) {
        const std::string_view word = cursor_.word_on_any_line();
        if (word.empty()) fail_at_end(f, face_count_, "faces");
        std::int64_t index = 0;
        if (!parse_integer(word, index)) {
            cursor_.fail("face " + std::to_string(f) + " has " + in_quotes(word) +
                         " where a vertex number should stand");
        }
        if (index < 0 || index >= vertex_count_) cursor_.fail(bad_index(f, index, vertex_count_));
        mesh_.corners.push_back(static_cast<int>(index));
    }

    [[noreturn]] void fail_at_end(std::int64_t found, std::int64_t promised, const std::string& what) const {
        cursor_.fail("the file ends after " + std::to_string(found) + " of the " + std::to_string(promised) +
                     " " + what + " its header promises; export the mesh again");
    }

    TextCursor cursor_;
    std::size_t size_;
    PolygonMesh mesh_;
    std::int64_t vertex_count_ = 0;
    std::int64_t face_count_ = 0;
};

template <typename Number>
void append(std::string& text, Number number, char separator) {
    char digits[32];
    text.append(digits, std::to_chars(digits, digits + sizeof digits, number).ptr);
    text.push_back(separator);
}

std::string header(int vertices, int faces) {
    return "OFF\n" + std::to_string(vertices) + " " + std::to_string(faces) + " 0\n";
}

void append_point(std::string& text, const Eigen::Vector3d& p) {
    append(text, p.x(), ' ');
    append(text, p.y(), ' ');
    append(text, p.z(), '\n');
}

}  // namespace

PolygonMesh read_off(std::string_view bytes, const std::string& path) { return OffReader(bytes, path).run(); }

void write_off(const std::string& path, const PolygonMesh& mesh) {
    std::string text = header(mesh.vertex_count(), mesh.face_count());
    for (const Eigen::Vector3d& p : mesh.vertices) append_point(text, p);
    for (std::size_t f = 0; f + 1 < mesh.offsets.size(); ++f) {
        const int begin = mesh.offsets[f];
        const int end = mesh.offsets[f + 1];
        append(text, end - begin, end > begin ? ' ' : '\n');
        for (int k = begin; k < end; ++k) append(text, mesh.corners[at(k)], k + 1 < end ? ' ' : '\n');
    }
    write_file(path, text);
}

void write_off(const std::string& path, const TriMesh& mesh) {
    std::string text = header(mesh.vertex_count(), mesh.face_count());
    for (int v = 0; v < mesh.vertex_count(); ++v) append_point(text, mesh.vertices.col(v));
    for (int f = 0; f < mesh.face_count(); ++f) {
        text += "3 ";
        for (int k = 0; k < 3; ++k) append(text, mesh.faces(k, f), k < 2 ? ' ' : '\n');
    }
    write_file(path, text);
}

}  // namespace coseg
