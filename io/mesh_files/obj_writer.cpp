#include "io/mesh_files/obj_writer.hpp"

#include <algorithm>
#include <cstdio>

#include "io/files/atomic_file.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/pictures/part_colors.hpp"

namespace coseg {

namespace {

std::string numbers(const char* keyword, double a, double b, double c) {
    char text[96];
    std::snprintf(text, sizeof text, "%s %.9g %.9g %.9g\n", keyword, a, b, c);
    return text;
}

std::string face_line(const PolygonMesh& mesh, std::size_t face) {
    std::string line = "f";
    for (int k = mesh.offsets[face]; k < mesh.offsets[face + 1]; ++k)
        line += " " + std::to_string(mesh.corners[at(k)] + 1);
    return line + "\n";
}

}  // namespace

void write_part_materials(const std::string& path, int parts) {
    std::string text = "# coseg: one material a part\n";
    for (int part = 0; part < parts; ++part) {
        const Color color = part_color(part);
        text += "newmtl part_" + std::to_string(part) + "\n" +
                numbers("Kd", color[0] / 255.0, color[1] / 255.0, color[2] / 255.0) + "Ka 0 0 0\nKs 0 0 0\n";
    }
    write_file(path, text);
}

void write_part_obj(const std::string& path, const std::string& material_file, const PolygonMesh& mesh,
                    const std::vector<int>& labels) {
    if (labels.size() != static_cast<std::size_t>(mesh.face_count())) {
        throw Error(ExitCode::internal, path + ": " + std::to_string(labels.size()) + " labels for " +
                                            std::to_string(mesh.face_count()) + " faces");
    }
    std::string text = "# coseg: faces grouped by part\nmtllib " + material_file + "\n";
    for (const Eigen::Vector3d& p : mesh.vertices) text += numbers("v", p.x(), p.y(), p.z());
    const int parts = labels.empty() ? 0 : *std::max_element(labels.begin(), labels.end()) + 1;
    for (int part = 0; part < parts; ++part) {
        if (std::find(labels.begin(), labels.end(), part) == labels.end()) continue;
        text += "g part_" + std::to_string(part) + "\nusemtl part_" + std::to_string(part) + "\n";
        for (std::size_t f = 0; f < labels.size(); ++f) {
            if (labels[f] == part) text += face_line(mesh, f);
        }
    }
    write_file(path, text);
}

}  // namespace coseg
