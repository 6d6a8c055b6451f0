#include "io/part_files/border_file.hpp"

#include <charconv>
#include <map>

#include "io/files/atomic_file.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

void append_digits(std::string& text, double value) {
    char digits[32];
    text += ' ';
    text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

}  // namespace

void write_border_lines(const std::string& path, const TriMesh& mesh, const std::vector<BorderCurve>& curves,
                        const std::vector<std::string>& part_names) {
    std::string text = "# coseg: the curves between parts\n";
    std::map<int, int> line_of_vertex;
    for (const BorderCurve& curve : curves) {
        for (const int v : curve.vertices) {
            if (!line_of_vertex.try_emplace(v, static_cast<int>(line_of_vertex.size()) + 1).second) continue;
            text += 'v';
            for (const double value : mesh.vertices.col(v)) append_digits(text, value);
            text += '\n';
        }
    }
    const BorderCurve* before = nullptr;
    for (const BorderCurve& curve : curves) {
        if (before == nullptr || before->part_a != curve.part_a || before->part_b != curve.part_b)
            text += "o " + part_names[at(curve.part_a)] + " | " + part_names[at(curve.part_b)] + "\n";
        before = &curve;
        text += 'l';
        for (const int v : curve.vertices) text += " " + std::to_string(line_of_vertex[v]);
        if (curve.is_closed) text += " " + std::to_string(line_of_vertex[curve.vertices.front()]);
        text += '\n';
    }
    write_file(path, text);
}

}  // namespace coseg
