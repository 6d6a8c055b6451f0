#include "io/mesh_files/off_writer.hpp"

#include <charconv>

#include "io/files/atomic_file.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

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
