#include "io/interface/shape_polygons.hpp"

#include "io/files/file_contents.hpp"
#include "io/mesh_files/mesh_reader.hpp"

namespace coseg {

std::string called(const Shape& shape, std::size_t index) {
    return "shape " + std::to_string(index) + (shape.name.empty() ? "" : " ('" + shape.name + "')");
}

ParsedMesh polygons_of(const Shape& shape, std::size_t index) {
    if (!shape.path.empty()) return parse_mesh(read_regular_file(shape.path), shape.path);
    return checked_polygons({shape.vertices, shape.corners, shape.offsets}, called(shape, index));
}

}  // namespace coseg
