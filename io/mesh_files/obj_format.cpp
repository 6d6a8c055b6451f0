#include "io/mesh_files/obj_format.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <iterator>
#include <vector>

#include "io/files/atomic_file.hpp"
#include "io/files/text_cursor.hpp"
#include "io/mesh_files/lost_digits.hpp"
#include "io/mesh_files/mesh_limits.hpp"
#include "io/mesh_files/unusable_vertices.hpp"
#include "src/base/index.hpp"
#include "src/pictures/part_colors.hpp"

namespace coseg {

namespace {

constexpr const char* material_file = "parts.mtl";

class ObjReader {
  public:
    ObjReader(std::string_view bytes, const std::string& path) : cursor_(bytes, path, '#'), path_(path) {
        cursor_.join_lines_at_backslash();
    }

    ParsedMesh run() {
        if (!cursor_.next_line()) cursor_.fail("the file is empty; export the mesh again");
        mesh_.offsets.push_back(0);
        const TextCursor begin = cursor_;
        do {
            const std::string_view keyword = cursor_.word();
            if (keyword == "v" || keyword == "V") read_vertex();
            if (keyword == "f" || keyword == "F" || keyword == "fo") read_face();
        } while (cursor_.next_line());
        if (vertex_count() == 0 && face_count() == 0) {
            begin.fail(
                "no line begins with 'v' or 'f' as the vertices and faces of an OBJ file do; export the "
                "mesh again");
        }
        if (highest_index_ >= vertex_count()) {
            cursor_.fail(bad_index(face_of_highest_index_, highest_index_, vertex_count()));
        }
        return unusable_.left_out_of({std::move(mesh_), {}}, path_);
    }

  private:
    [[nodiscard]] std::int64_t vertex_count() const { return std::ssize(mesh_.vertices); }
    [[nodiscard]] std::int64_t face_count() const { return std::ssize(mesh_.offsets) - 1; }

    void read_vertex() {
        if (vertex_count() >= most_vertices) cursor_.fail(too_many_vertices);
        Eigen::Vector3d point;
        for (int k = 0; k < 3; ++k) {
            const std::string_view word = cursor_.word();
            if (!parse_real(word, point[k])) {
                cursor_.fail("vertex " + std::to_string(vertex_count()) +
                             " needs three coordinates, but one is " + no_number(word));
            }
            if (!is_usable_coordinate(point[k])) unusable_.add(vertex_count(), point[k], cursor_.line());
        }
        mesh_.vertices.push_back(point);
    }

    void read_face() {
        for (std::string_view word = cursor_.word(); !word.empty(); word = cursor_.word()) {
            mesh_.corners.push_back(vertex_number(word));
        }
        drop_repeated_corners();
        if (std::ssize(mesh_.corners) > most_corners) cursor_.fail(too_many_corners);
        mesh_.offsets.push_back(static_cast<int>(mesh_.corners.size()));
    }

    /// Some exporters write a triangle as a quadrangle that names a vertex twice in a row, or as its last
    /// corner and its first: it counts once then, unless fewer than three corners are left. Other repetitions
    /// stay, as they lead to a hole of the face and back.
    void drop_repeated_corners() {
        const auto begin = mesh_.corners.begin() + mesh_.offsets.back();
        ring_.clear();
        std::unique_copy(begin, mesh_.corners.end(), std::back_inserter(ring_));
        while (ring_.size() > 1 && ring_.back() == ring_.front()) ring_.pop_back();
        if (ring_.size() < 3) return;
        mesh_.corners.erase(std::copy(ring_.begin(), ring_.end(), begin), mesh_.corners.end());
    }

    /// Vertices are counted from 1, or from -1 backwards. A face may come before its vertices, so that too
    /// high numbers show at the end of the file only.
    int vertex_number(std::string_view word) {
        std::int64_t index = 0;
        if (!parse_whole(word.substr(0, word.find('/')), index)) {
            cursor_.fail("face " + std::to_string(face_count()) + " has " + in_quotes(word) +
                         " where a vertex number should stand");
        }
        const std::int64_t number = index < 0 ? vertex_count() + index : index - 1;
        if (number < 0 || number >= most_vertices) {
            cursor_.fail("face " + std::to_string(face_count()) + " refers to vertex " +
                         std::to_string(index) + " of the " + std::to_string(vertex_count()) +
                         " so far (OBJ counts from 1); correct the face");
        }
        if (number > highest_index_) {
            highest_index_ = number;
            face_of_highest_index_ = face_count();
        }
        return static_cast<int>(number);
    }

    TextCursor cursor_;
    const std::string& path_;
    PolygonMesh mesh_;
    UnusableVertices unusable_;
    std::vector<int> ring_;  ///< the corners of the face at hand without those that repeat the one before
    std::int64_t highest_index_ = -1;
    std::int64_t face_of_highest_index_ = 0;
};

constexpr int digits_of_single_precision = 9;
constexpr int digits_of_double_precision = 17;

std::string numbers(const char* keyword, double a, double b, double c,
                    int digits = digits_of_single_precision) {
    char text[96];
    std::snprintf(text, sizeof text, "%s %.*g %.*g %.*g\n", keyword, digits, a, digits, b, digits, c);
    return text;
}

/// A space would make a second group of the rest, and the end of a line a statement.
std::string as_one_word(std::string name) {
    for (char& c : name) {
        if (static_cast<unsigned char>(c) <= ' ') c = '_';
    }
    return name;
}

std::string face_line(const PolygonMesh& mesh, std::size_t face) {
    std::string line = "f";
    for (int k = mesh.offsets[face]; k < mesh.offsets[face + 1]; ++k)
        line += " " + std::to_string(mesh.corners[at(k)] + 1);
    return line + "\n";
}

}  // namespace

ParsedMesh read_obj(std::string_view bytes, const std::string& path) { return ObjReader(bytes, path).run(); }

void write_obj_materials(const std::string& folder, int parts) {
    std::string text = "# coseg: one material a part\n";
    for (int part = 0; part < parts; ++part) {
        const Color color = part_color(part);
        text += "newmtl part_" + std::to_string(part) + "\n" +
                numbers("Kd", color[0] / 255.0, color[1] / 255.0, color[2] / 255.0) + "Ka 0 0 0\nKs 0 0 0\n";
    }
    write_file(folder + "/" + material_file, text);
}

void write_obj(const std::string& path, const PolygonMesh& mesh, const FaceArrays& arrays) {
    const std::vector<int>& labels = parts_of(arrays, mesh.face_count(), path);
    std::string text = std::string("# coseg: faces grouped by part\nmtllib ") + material_file + "\n";
    const int digits = lost_digits(mesh) ? digits_of_double_precision : digits_of_single_precision;
    for (const Eigen::Vector3d& p : mesh.vertices) text += numbers("v", p.x(), p.y(), p.z(), digits);
    const int parts = labels.empty() ? 0 : *std::max_element(labels.begin(), labels.end()) + 1;
    for (int part = 0; part < parts; ++part) {
        if (std::find(labels.begin(), labels.end(), part) == labels.end()) continue;
        text += "g " + as_one_word(part_name(arrays, part)) + "\nusemtl part_" + std::to_string(part) + "\n";
        for (std::size_t f = 0; f < labels.size(); ++f) {
            if (labels[f] == part) text += face_line(mesh, f);
        }
    }
    write_file(path, text);
}

}  // namespace coseg
