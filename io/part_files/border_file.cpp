#include "io/part_files/border_file.hpp"

#include <charconv>
#include <map>

#include "io/files/atomic_file.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

template <class Value>
void append_digits(std::string& text, Value value) {
    char digits[32];
    text += ' ';
    text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

/// Vertices of all curves, numbered from 0 in the order in which curves first name them.
class CurveVertices {
  public:
    explicit CurveVertices(const std::vector<BorderCurve>& curves) {
        for (const BorderCurve& curve : curves) {
            for (const int v : curve.vertices) {
                if (number_.try_emplace(v, static_cast<int>(order_.size())).second) order_.push_back(v);
            }
        }
    }
    [[nodiscard]] const std::vector<int>& order() const noexcept { return order_; }
    [[nodiscard]] int number(int vertex) const { return number_.at(vertex); }
    /// Those of a curve; a closed one ends where it begins.
    [[nodiscard]] std::vector<int> along(const BorderCurve& curve) const {
        std::vector<int> numbers;
        for (const int v : curve.vertices) numbers.push_back(number(v));
        if (curve.is_closed) numbers.push_back(numbers.front());
        return numbers;
    }

  private:
    std::map<int, int> number_;
    std::vector<int> order_;
};

template <class Value>
std::string data_array(const std::string& type, const std::string& name, int components,
                       const std::vector<Value>& values) {
    std::string text = "<DataArray type=\"" + type + "\" Name=\"" + name + "\" NumberOfComponents=\"" +
                       std::to_string(components) + "\" format=\"ascii\">\n";
    for (const Value& value : values) append_digits(text, value);
    return text + "\n</DataArray>\n";
}

}  // namespace

void write_border_lines(const std::string& path, const TriMesh& mesh, const std::vector<BorderCurve>& curves,
                        const std::vector<std::string>& part_names) {
    std::string text = "# coseg: the curves between parts\n";
    const CurveVertices vertices(curves);
    for (const int v : vertices.order()) {
        text += 'v';
        for (const double value : mesh.vertices.col(v)) append_digits(text, value);
        text += '\n';
    }
    const BorderCurve* before = nullptr;
    for (const BorderCurve& curve : curves) {
        if (before == nullptr || before->part_a != curve.part_a || before->part_b != curve.part_b)
            text += "o " + part_names[at(curve.part_a)] + " | " + part_names[at(curve.part_b)] + "\n";
        before = &curve;
        text += 'l';
        for (const int number : vertices.along(curve)) append_digits(text, number + 1);
        text += '\n';
    }
    write_file(path, text);
}

void write_border_vtp(const std::string& path, const TriMesh& mesh, const std::vector<BorderCurve>& curves) {
    const CurveVertices vertices(curves);
    std::vector<double> points;
    std::vector<int> corners;
    std::vector<int> ends;
    std::vector<int> part_a;
    std::vector<int> part_b;
    std::vector<int> closed;
    for (const int v : vertices.order()) {
        for (const double value : mesh.vertices.col(v)) points.push_back(value);
    }
    for (const BorderCurve& curve : curves) {
        for (const int number : vertices.along(curve)) corners.push_back(number);
        ends.push_back(static_cast<int>(corners.size()));
        part_a.push_back(curve.part_a);
        part_b.push_back(curve.part_b);
        closed.push_back(curve.is_closed ? 1 : 0);
    }
    write_file(
        path,
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
        "<PolyData>\n<Piece NumberOfPoints=\"" +
            std::to_string(vertices.order().size()) + "\" NumberOfVerts=\"0\" NumberOfLines=\"" +
            std::to_string(curves.size()) + "\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n<Points>\n" +
            data_array("Float64", "points", 3, points) + "</Points>\n<Lines>\n" +
            data_array("Int32", "connectivity", 1, corners) + data_array("Int32", "offsets", 1, ends) +
            "</Lines>\n<CellData>\n" + data_array("Int32", "part_a", 1, part_a) +
            data_array("Int32", "part_b", 1, part_b) + data_array("Int32", "closed", 1, closed) +
            "</CellData>\n</Piece>\n</PolyData>\n</VTKFile>\n");
}

}  // namespace coseg
