#include "io/mesh_files/vtk_writer.hpp"

#include <cstdint>
#include <string_view>

#include "io/files/atomic_file.hpp"
#include "io/files/byte_cursor.hpp"
#include "io/mesh_files/lost_digits.hpp"
#include "src/base/error.hpp"
#include "src/base/text.hpp"

namespace coseg {

namespace {

/// The XML of the arrays, and behind them their bytes, each with its length before it.
class AppendedArrays {
  public:
    template <class T, class Values>
    std::string add(const std::string& type, const std::string& name, int components, const Values& values) {
        std::string element = "<DataArray type=\"" + type + "\" Name=\"" + name + "\" NumberOfComponents=\"" +
                              std::to_string(components) + "\" format=\"appended\" offset=\"" +
                              std::to_string(bytes_.size()) + "\"/>\n";
        append_little_endian(bytes_, static_cast<std::uint64_t>(values.size() * sizeof(T)));
        for (const auto& value : values) append_little_endian(bytes_, static_cast<T>(value));
        return element;
    }

    [[nodiscard]] const std::string& bytes() const { return bytes_; }

  private:
    std::string bytes_;
};

void check_count(const std::string& path, const std::string& name, std::size_t count,
                 const PolygonMesh& mesh) {
    if (count == static_cast<std::size_t>(mesh.face_count())) return;
    throw Error(ExitCode::internal, path + ": " + std::to_string(count) + " values of " + name + " for " +
                                        std::to_string(mesh.face_count()) + " faces");
}

std::vector<double> coordinates(const PolygonMesh& mesh) {
    std::vector<double> values;
    values.reserve(3 * mesh.vertices.size());
    for (const Eigen::Vector3d& p : mesh.vertices) values.insert(values.end(), p.data(), p.data() + 3);
    return values;
}

}  // namespace

void write_vtp(const std::string& path, const PolygonMesh& mesh, const FaceArrays& arrays) {
    AppendedArrays appended;
    std::string xml =
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
        "header_type=\"UInt64\">\n<PolyData>\n<Piece NumberOfPoints=\"" +
        std::to_string(mesh.vertex_count()) +
        "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" " + "NumberOfPolys=\"" +
        std::to_string(mesh.face_count()) + "\">\n";
    const std::vector<double> points = coordinates(mesh);
    xml += "<Points>\n" +
           (lost_digits(mesh) ? appended.add<double>("Float64", "points", 3, points)
                              : appended.add<float>("Float32", "points", 3, points)) +
           "</Points>\n";
    const std::vector<int> ends(mesh.offsets.begin() + (mesh.offsets.empty() ? 0 : 1), mesh.offsets.end());
    xml += "<Polys>\n" + appended.add<std::int32_t>("Int32", "connectivity", 1, mesh.corners) +
           appended.add<std::int32_t>("Int32", "offsets", 1, ends) + "</Polys>\n";
    xml += arrays.labels.empty() ? "<CellData>\n"
                                 : "<CellData Scalars=\"" + arrays.labels.front().first + "\">\n";
    for (const auto& [name, values] : arrays.labels) {
        check_count(path, name, values.size(), mesh);
        xml += appended.add<std::int32_t>("Int32", name, 1, values);
    }
    for (const auto& [name, values] : arrays.values) {
        check_count(path, name, values.size(), mesh);
        xml += appended.add<float>("Float32", name, 1, values);
    }
    xml += "</CellData>\n</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_";
    write_file(path, xml + appended.bytes() + "\n</AppendedData>\n</VTKFile>\n");
}

void write_vtm(const std::string& path, const std::vector<std::pair<std::string, std::string>>& files) {
    std::string xml =
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"vtkMultiBlockDataSet\" version=\"1.0\" "
        "byte_order=\"LittleEndian\">\n<vtkMultiBlockDataSet>\n";
    for (std::size_t k = 0; k < files.size(); ++k) {
        xml += "<DataSet index=\"" + std::to_string(k) + "\" name=\"" + escaped(files[k].first) +
               "\" file=\"" + escaped(files[k].second) + "\"/>\n";
    }
    write_file(path, xml + "</vtkMultiBlockDataSet>\n</VTKFile>\n");
}

}  // namespace coseg
