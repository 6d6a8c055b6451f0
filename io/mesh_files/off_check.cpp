#include <algorithm>
#include <limits>

#include "io/files/text_cursor.hpp"
#include "io/mesh_files/mesh_check.hpp"

namespace coseg {

namespace {

class OffCheck {
  public:
    OffCheck(std::string_view bytes, const std::string& path) : cursor_(bytes, path, '#'), bytes_(bytes) {}

    CheckedMesh run() {
        mesh_.extension = "off";
        mesh_.plain.reserve(bytes_.size() + 64);
        check_header();
        mesh_.plain = "OFF\n" + std::to_string(vertices_) + " " + std::to_string(faces_) + " 0\n";
        for (long long v = 0; v < vertices_; ++v) check_vertex(v);
        for (long long f = 0; f < faces_; ++f) check_face(f);
        if (cursor_.next_line()) {
            cursor_.fail("the file goes on after the " + std::to_string(faces_) +
                         " faces its header promises; correct the counts in the header");
        }
        mesh_.face_count = static_cast<int>(faces_);
        return std::move(mesh_);
    }

  private:
    void check_header() {
        if (!cursor_.next_line()) cursor_.fail("the file is empty; export the mesh again");
        std::string_view keyword = cursor_.word();
        for (const std::string_view prefix : {"ST", "C", "N"}) {
            if (keyword.substr(0, prefix.size()) == prefix) keyword.remove_prefix(prefix.size());
        }
        if (keyword == "4OFF" || keyword == "nOFF" || keyword == "4nOFF") {
            cursor_.fail("only three coordinates a vertex are understood; export the mesh as plain OFF");
        }
        if (keyword.substr(0, 3) != "OFF")
            cursor_.fail("an OFF file begins with OFF, this one with " + quoted(keyword));
        keyword.remove_prefix(3);  // some collections write the first count right behind: "OFF490 518 0"
        std::string_view first = keyword.empty() ? cursor_.word_on_any_line() : keyword;
        if (first == "BINARY")
            cursor_.fail("binary OFF is not understood; export the mesh as ASCII OFF or PLY");
        vertices_ = count(first, "vertices");
        faces_ = count(cursor_.word_on_any_line(), "faces");
    }

    long long count(std::string_view word, const std::string& what) {
        long long value = 0;
        if (word.empty()) cursor_.fail("the file ends in its header, before the number of " + what);
        if (!parse_integer(word, value) || value < 0 || value > std::numeric_limits<int>::max()) {
            cursor_.fail("the number of " + what + " in the header is " + quoted(word) +
                         ", which is no count");
        }
        return value;
    }

    void check_vertex(long long v) {
        if (!cursor_.next_line()) ends_early(v, vertices_, "vertices");
        Eigen::Vector3d point;
        for (int k = 0; k < 3; ++k) {
            const std::string_view word = cursor_.word();
            if (!parse_real(word, point[k])) {
                cursor_.fail("vertex " + std::to_string(v) + " needs three coordinates, but one is " +
                             quoted(word));
            }
            const std::string wrong = bad_coordinate(v, point[k]);
            if (!wrong.empty()) cursor_.fail(wrong);
            mesh_.plain.append(word).push_back(k < 2 ? ' ' : '\n');
        }
        mesh_.vertices.push_back(point);
    }

    void check_face(long long f) {
        if (!cursor_.next_line()) ends_early(f, faces_, "faces");
        const std::string_view first = cursor_.word();
        long long corners = 0;
        if (!parse_integer(first, corners) || corners < 1) {
            cursor_.fail("face " + std::to_string(f) + " begins with " + quoted(first) +
                         " instead of its number of corners");
        }
        mesh_.plain.append(first);
        for (long long k = 0; k < corners; ++k) {
            const std::string_view word = cursor_.word_on_any_line();
            if (word.empty()) ends_early(f, faces_, "faces");
            long long index = 0;
            if (!parse_integer(word, index)) {
                cursor_.fail("face " + std::to_string(f) + " has " + quoted(word) +
                             " where a vertex number should stand");
            }
            if (index < 0 || index >= vertices_) cursor_.fail(bad_index(f, index, vertices_));
            mesh_.plain.append(" ").append(word);
        }
        mesh_.plain.push_back('\n');
        corners_ += corners;
        if (corners_ > most_corners) cursor_.fail("the mesh has too many corners; split it");
    }

    [[noreturn]] void ends_early(long long found, long long promised, const std::string& what) const {
        cursor_.fail("the file ends after " + std::to_string(found) + " of the " + std::to_string(promised) +
                     " " + what + " its header promises; export the mesh again");
    }

    TextCursor cursor_;
    std::string_view bytes_;
    CheckedMesh mesh_;
    long long vertices_ = 0;
    long long faces_ = 0;
    long long corners_ = 0;
};

}  // namespace

CheckedMesh check_off(std::string_view bytes, const std::string& path) { return OffCheck(bytes, path).run(); }

}  // namespace coseg
