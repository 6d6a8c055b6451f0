#pragma once
// A polygon mesh as it stands in a file: nothing triangulated, welded or repaired.

#include <Eigen/Core>
#include <vector>

namespace coseg {

/// Faces keep the order and the number that they have in the file, whatever their shape, because every one of
/// them is given a label.
struct PolygonMesh {
    std::vector<Eigen::Vector3d> vertices;
    std::vector<int> offsets;  ///< F + 1 (or empty): face f's corners are corners[offsets[f] .. offsets[f+1])
    std::vector<int> corners;  ///< vertex numbers, 0 .. V-1

    [[nodiscard]] int vertex_count() const noexcept { return static_cast<int>(vertices.size()); }
    [[nodiscard]] int face_count() const noexcept {
        return offsets.empty() ? 0 : static_cast<int>(offsets.size()) - 1;
    }
};

}  // namespace coseg
