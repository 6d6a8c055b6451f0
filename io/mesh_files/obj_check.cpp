#include <algorithm>
#include <charconv>
#include <limits>

#include "io/files/text_cursor.hpp"
#include "io/mesh_files/mesh_check.hpp"

namespace coseg {

namespace {

class ObjCheck {
  public:
    ObjCheck(std::string_view bytes, const std::string& path) : cursor_(bytes, path, '#'), bytes_(bytes) {
        cursor_.join_lines_at_backslash();
    }

    CheckedMesh run() {
        mesh_.extension = "obj";
        mesh_.plain.reserve(bytes_.size() + 64);
        if (!cursor_.next_line()) cursor_.fail("the file is empty; export the mesh again");
        do {
            const std::string_view keyword = cursor_.word();
            if (keyword == "v") check_vertex();
            if (keyword == "f") check_face();
        } while (cursor_.next_line());
        if (highest_index_ >= vertex_count()) {
            cursor_.fail(bad_index(face_of_highest_index_, highest_index_, vertex_count()));
        }
        return std::move(mesh_);
    }

  private:
    [[nodiscard]] long long vertex_count() const { return static_cast<long long>(mesh_.vertices.size()); }

    void check_vertex() {
        Eigen::Vector3d point;
        mesh_.plain.append("v");
        for (int k = 0; k < 3; ++k) {
            const std::string_view word = cursor_.word();
            if (!parse_real(word, point[k])) {
                cursor_.fail("vertex " + std::to_string(vertex_count()) +
                             " needs three coordinates, but one is " + quoted(word));
            }
            const std::string wrong = bad_coordinate(vertex_count(), point[k]);
            if (!wrong.empty()) cursor_.fail(wrong);
            mesh_.plain.append(" ").append(word);
        }
        mesh_.plain.push_back('\n');
        mesh_.vertices.push_back(point);
    }

    /// Vertices are counted from 1, or from -1 backwards; what follows a slash is texture and normal.
    int vertex_number(std::string_view word) {
        long long index = 0;
        if (!parse_integer(word.substr(0, word.find('/')), index)) {
            cursor_.fail("face " + std::to_string(mesh_.face_count) + " has " + quoted(word) +
                         " where a vertex number should stand");
        }
        const long long number = index < 0 ? vertex_count() + index : index - 1;
        if (number < 0 || number >= std::numeric_limits<int>::max()) {
            cursor_.fail("face " + std::to_string(mesh_.face_count) + " refers to vertex " +
                         std::to_string(index) + " of the " + std::to_string(vertex_count()) +
                         " so far (OBJ counts from 1); correct the face");
        }
        if (number > highest_index_) {
            highest_index_ = number;
            face_of_highest_index_ = mesh_.face_count;
        }
        return static_cast<int>(number);
    }

    void check_face() {
        corners_.clear();
        for (std::string_view word = cursor_.word(); !word.empty(); word = cursor_.word()) {
            corners_.push_back(vertex_number(word));
        }
        if (corners_.empty())
            cursor_.fail("face " + std::to_string(mesh_.face_count) + " has no corners; correct the line");
        all_corners_ += static_cast<long long>(corners_.size());
        if (all_corners_ > most_corners) cursor_.fail("the mesh has too many corners; split it");
        sorted_ = corners_;
        std::sort(sorted_.begin(), sorted_.end());
        const bool is_kept = std::unique(sorted_.begin(), sorted_.end()) - sorted_.begin() > 2;
        if (is_kept)
            write_face();
        else
            mesh_.left_out.push_back({mesh_.face_count, corners_, {}});
        ++mesh_.face_count;
    }

    void write_face() {
        mesh_.plain.append("f");
        char digits[16];
        for (const int corner : corners_) {
            const auto end = std::to_chars(digits, digits + sizeof digits, corner + 1LL).ptr;
            mesh_.plain.append(" ").append(digits, end);
        }
        mesh_.plain.push_back('\n');
    }

    TextCursor cursor_;
    std::string_view bytes_;
    CheckedMesh mesh_;
    std::vector<int> corners_;
    std::vector<int> sorted_;
    long long all_corners_ = 0;
    long long highest_index_ = -1;
    int face_of_highest_index_ = 0;
};

}  // namespace

CheckedMesh check_obj(std::string_view bytes, const std::string& path) { return ObjCheck(bytes, path).run(); }

}  // namespace coseg
