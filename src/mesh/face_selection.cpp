#include "src/mesh/face_selection.hpp"

#include "src/base/index.hpp"

namespace coseg {

PolygonMesh selected_faces(const PolygonMesh& mesh, const std::vector<int>& faces) {
    PolygonMesh selected;
    selected.offsets.push_back(0);
    for (const int f : faces) {
        for (int k = mesh.offsets[at(f)]; k < mesh.offsets[at(f) + 1]; ++k)
            selected.corners.push_back(mesh.corners[at(k)]);
        selected.offsets.push_back(static_cast<int>(selected.corners.size()));
    }
    std::vector<int> new_number(mesh.vertices.size(), -1);
    for (const int corner : selected.corners) new_number[at(corner)] = 0;
    for (std::size_t v = 0; v < new_number.size(); ++v) {
        if (new_number[v] < 0) continue;
        new_number[v] = selected.vertex_count();
        selected.vertices.push_back(mesh.vertices[v]);
    }
    for (int& corner : selected.corners) corner = new_number[at(corner)];
    return selected;
}

}  // namespace coseg
