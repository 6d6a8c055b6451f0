#pragma once
// A polygon mesh as it stands in a file or in a caller's memory: nothing triangulated, welded or repaired.

#include <Eigen/Core>
#include <span>
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

/// Polygons in the memory of a caller, who keeps it as long as they are used. Nothing is known of the values.
struct PolygonView {
    std::span<const double> coordinates;  ///< 3 V: x, y and z of each vertex
    std::span<const int> corners;         ///< vertex numbers, one face after the other
    std::span<const int> offsets;         ///< as in PolygonMesh; empty where every face is a triangle
};

}  // namespace coseg
